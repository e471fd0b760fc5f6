// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/formats/merl.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::read_file;
using gonio::test::TemporaryFolder;

namespace {

/// A table full of zeros; the file is sparse and costs no disk.
std::filesystem::path zeros(const TemporaryFolder& scratch, const std::string& name, std::uintmax_t size = merl_file_size) {
  const std::filesystem::path path = scratch.file(name, std::string("\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", 12));
  std::filesystem::resize_file(path, size);
  return path;
}

void put(const std::filesystem::path& path, std::size_t offset, std::string_view bytes) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(offset));
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void put(const std::filesystem::path& path, std::size_t plane, std::size_t cell, double value) {
  put(path, merl_header_size + 8 * (plane * MerlGrid::cell_count + cell), {reinterpret_cast<const char*>(&value), sizeof value});
}

}  // namespace

TEST_CASE("A truncated or oversized file is refused with the bytes found and wanted") {
  const TemporaryFolder scratch;
  for (const std::uintmax_t size : {1u, 11u, 12u, 1000000u, 34992011u, 34992013u, 69984012u}) {
    const std::string refused = faults_of([&] { open_brdf(zeros(scratch, "m.binary", size)); });
    CHECK(refused.find("m.binary|" + std::to_string(size) + " bytes|34992012 bytes") != std::string::npos);
  }
}

TEST_CASE("Other dimensions are refused with the dimensions found and wanted") {
  const TemporaryFolder scratch;
  const auto path = zeros(scratch, "m.binary");
  put(path, 8, std::string_view("\x68\x01", 2));
  CHECK(faults_of([&] { open_brdf(path); }).find("dimensions 90 x 90 x 360|dimensions 90 x 90 x 180") != std::string::npos);
  put(path, 0, "text, not numbers");
  CHECK(faults_of([&] { open_brdf(path); }).find("dimensions") != std::string::npos);
  const auto both = zeros(scratch, "both.binary", 500);
  put(both, 0, std::string_view("\x10", 1));
  const std::string refused = faults_of([&] { open_brdf(both); });
  CHECK(refused.find("500 bytes") != std::string::npos);
  CHECK(refused.find("dimensions 16 x 90 x 180") != std::string::npos);
}

TEST_CASE("A cell with a negative channel is masked and counted; a number that is none is a fault with its cell") {
  const TemporaryFolder scratch;
  const auto path = zeros(scratch, "m.binary");
  put(path, 1, 7, -0.5);
  put(path, 2, 7, -0.5);
  put(path, 0, 1457999, -1.0);
  CHECK(open_brdf(path).masked.missing == 2);
  put(path, 1, MerlGrid::index({3, 4, 5}), std::numeric_limits<double>::quiet_NaN());
  put(path, 2, 1457999, std::numeric_limits<double>::infinity());
  const std::string refused = faults_of([&] { open_brdf(path); });
  CHECK(refused.find("cell theta_h 3, theta_d 4, phi_d 5|nan in plane 2|") != std::string::npos);
  CHECK(refused.find("cell theta_h 89, theta_d 89, phi_d 179|inf in plane 3|") != std::string::npos);
}

TEST_CASE("The blocks of an opened file point into the mapping and outlive the opening") {
  const TemporaryFolder scratch;
  const auto path = zeros(scratch, "m.binary");
  put(path, 1, MerlGrid::index({3, 4, 5}), 1500.0);
  std::shared_ptr<const Observations> observations;
  {
    const Opened opened = open_brdf(path);
    CHECK(opened.format == "merl");
    CHECK_FALSE(opened.dataset);
    observations = opened.observations;
  }
  const ObservationBlock block = observations->block(3);
  CHECK(block.f[1][4 * 180 + 5] == Approx(1.15));
  CHECK(block.f[0][4 * 180 + 5] == 0);
}

TEST_CASE("A damaged sidecar is refused, one without a node rule leaves the default") {
  const TemporaryFolder scratch;
  const auto path = zeros(scratch, "m.binary");
  scratch.file("m.binary.json", "{\"node_rule\":\"middle\"}");
  CHECK(faults_of([&] { open_brdf(path); }).find("m.binary.json#/node_rule|'middle'|left or centre") != std::string::npos);
  for (const char* text : {"{", "{\"node_rule\":7}", ""}) {
    scratch.file("m.binary.json", text);
    CHECK(faults_of([&] { open_brdf(path); }).find("input|") == 0);
  }
  scratch.file("m.binary.json", "{\"note\":\"of somebody else\"}");
  CHECK(open_brdf(path).format == "merl");
}

TEST_CASE("No damaged header or length does more than raise an error") {
  const TemporaryFolder scratch;
  std::mt19937 random(20260704);
  const auto path = scratch / "m.binary";
  for (int round = 0; round < 1500; ++round) {
    std::string head("\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", 12);
    for (int edit = 0; edit < 2; ++edit) head[random() % head.size()] = static_cast<char>(random() % 4 == 0 ? random() : 0);
    head.resize(random() % (head.size() + 1));
    scratch.file("m.binary", head);
    // A whole file only now and then: it is read from end to end.
    std::filesystem::resize_file(path, round % 100 == 0 ? merl_file_size : head.size() + random() % 5000);
    INFO("round " << round << " of seed 20260704");
    ReadOptions options;
    options.format = "merl";
    try {
      open_brdf(path, options);
    } catch (const Error& error) {
      REQUIRE(error.kind() == ErrorKind::input);
    }
  }
  SUCCEED();
}

TEST_CASE("Numbers that are none are found wherever they stand in the file") {
  const TemporaryFolder scratch;
  std::mt19937 random(20260704);
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
  for (int round = 0; round < 40; ++round) {
    const auto path = zeros(scratch, "m.binary");
    const std::size_t plane = random() % 3, cell = random() % MerlGrid::cell_count;
    put(path, plane, cell, bad[round % 3]);
    INFO("round " << round << " of seed 20260704");
    const MerlCell at = MerlGrid::cell(cell);
    CHECK(faults_of([&] { open_brdf(path); })
              .find(fmt::format("cell theta_h {}, theta_d {}, phi_d {}|{} in plane {}|", at.theta_h, at.theta_d, at.phi_d, bad[round % 3],
                                plane + 1)) != std::string::npos);
  }
}
