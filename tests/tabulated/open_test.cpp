// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/open.hpp"

#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

TEST_CASE("A file is opened by what it holds, not by its name") {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(scratch.file("samples.bin", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n30,0,40,180,1\n"));
  CHECK(opened.format == "csv");
  REQUIRE(opened.dataset);
  CHECK(opened.dataset->size() == 1);
  REQUIRE(opened.observations);
  CHECK(opened.observations->block_count() == 1);
  CHECK_FALSE(opened.info.empty());
}

TEST_CASE("What cannot be a BRDF is refused with what was found") {
  const TemporaryFolder scratch;
  CHECK(faults_of([&] { open_brdf(scratch / "nothing"); }).find("no such file") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch.path()); }).find("not a file") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch.file("empty", "")); }).find("an empty file") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch.file("noise", std::string(100, '\1'))); }).find("100 bytes of an unknown kind") !=
        std::string::npos);
  ReadOptions options;
  options.format = "tiff";
  CHECK(faults_of([&] { open_brdf(scratch.file("x", "1 2 3"), options); }).find("usage|--format|tiff|one of ") == 0);
}

TEST_CASE("An answer to what a reader never asks is refused") {
  const TemporaryFolder scratch;
  ReadOptions options;
  options.assume["moon"] = "full";
  const auto samples = scratch.file("x.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n30,0,40,180,1\n");
  CHECK(faults_of([&] { open_brdf(samples, options); }).find("usage|--assume moon|") == 0);
}

TEST_CASE("Every format has a name of its own, a description, and a reader or a writer") {
  for (const Format& format : formats()) {
    CHECK(std::string(format.description).size() > 10);
    CHECK((format.recognises == nullptr) == (format.open == nullptr));
    CHECK((format.open || format.write));
    if (format.write) CHECK(format.extension[0] == '.');
    CHECK(std::count_if(formats().begin(), formats().end(), [&](const Format& other) { return std::string(other.name) == format.name; }) ==
          1);
  }
}
