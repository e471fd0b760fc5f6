// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/bird.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tabulated/samples_to_write.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using test::faults_of;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Opened measured() {
  Dataset data;
  for (const double nm : {450.0, 550.0}) {
    data.channels.push_back(single_channel(nm == 450 ? "450nm" : "550nm").front());
    data.channels.back().wavelength_in_nm = nm;
    data.channels.back().polarisation_in = nm == 450 ? "s" : "p";
  }
  data.symmetry = {.isotropic = true, .bilateral = true, .reciprocal = false};
  data.angles = {{30_deg, 0_deg, 40_deg, 180_deg}, {30_deg, 0_deg, 0_deg, 0_deg}, {60_deg, 350_deg, 89.5_deg, 170_deg}};
  data.f = {{0.3, 0.1, -0.001}, {1.0 / 3, unknown, 0.2}};
  data.u = {{0.01, 0.02, 0.001}, {0.1 / 3, unknown, unknown}};
  data.extra["repeat"] = {1, 2, 3};
  data.provenance = {{"sample", "card"}, {"timestamp", "2026-07-01T12:00:00Z"}, {"uncertainty_theta_i", "0.1 deg"}};
  Opened out;
  out.format = "test";
  out.dataset = std::make_shared<const Dataset>(data);
  return out;
}

/// The smallest document with one value, around the members of `data` that differ.
std::string with(const std::string& members) {
  return R"({"metadata": {"timestamp": "", "provenance": {}}, "data": {"theta_i": {"unit": "deg", "values": [10]},
    "phi_i": {"unit": "deg", "values": [0]}, "theta_r": {"unit": "rad", "values": [0.5]}, "phi_r": {"unit": "rad", "values": [3]}, )" +
         members + "}}";
}

Opened open(const std::string& text, const ReadOptions& options = {}) {
  const test::TemporaryFolder scratch;
  return open_brdf(scratch.file("x.json", text), options);
}

}  // namespace

TEST_CASE("Samples with uncertainties come back as they were, except what the format excludes") {
  const test::TemporaryFolder scratch;
  const ExportNotes notes = write_bird(measured(), scratch / "x.json", {});
  const Opened read = open_brdf(scratch / "x.json");
  CHECK(read.format == "bird-json");
  const Opened source = measured();
  const Dataset &data = *read.dataset, &was = *source.dataset;
  REQUIRE(data.size() == was.size());
  REQUIRE(data.channels.size() == 2);
  CHECK(data.channels == was.channels);
  CHECK(data.symmetry == was.symmetry);
  for (std::size_t k = 0; k < was.size(); ++k) {
    CHECK(data.angles[k].theta_o.degrees() == was.angles[k].theta_o.degrees());
    CHECK(data.angles[k].phi_i.degrees() == was.angles[k].phi_i.degrees());
    for (std::size_t c = 0; c < 2; ++c) {
      if (std::isnan(was.f[c][k])) {
        CHECK(std::isnan(data.f[c][k]));
        continue;
      }
      CHECK(data.f[c][k] == std::max(0.0, was.f[c][k]));
      CHECK((data.u[c][k] == was.u[c][k] || (std::isnan(data.u[c][k]) && std::isnan(was.u[c][k]))));
    }
  }
  CHECK(data.extra.at("repeat") == was.extra.at("repeat"));
  CHECK(data.provenance.at("uncertainty_theta_i") == "0.1 deg");
  CHECK(notes.n_negative == 1);
  CHECK_FALSE(read.simulated);

  // Written again from its own reading it is the same file.
  write_bird(read, scratch / "again.json", {});
  CHECK(read_file(scratch / "again.json") == read_file(scratch / "x.json"));
}

TEST_CASE("What is written meets the public schema's rules") {
  const test::TemporaryFolder scratch;
  Opened model;
  model.format = "fit-json";
  model.brdf = std::make_shared<AnalyticBrdf>("phong", rgb_channels(), std::vector<std::vector<double>>(3, {0.1, 0.3, 40}));
  WriteOptions options;
  options.size = GridSize::paper;
  for (const Opened& source : {measured(), model}) {
    write_bird(source, scratch / "x.json", options);
    const Json document = parse_json(read_file(scratch / "x.json"), "x");
    for (const Fault& fault : gonio::faults_of(document, Schema::bird_brdf, "")) FAIL_CHECK(fault.where << " " << fault.found);
    for (const auto& [name, variable] : document.at("data").members())
      if (name.starts_with("theta") || name.starts_with("phi")) CHECK(variable.at("unit").string() == "deg");
  }
  const Opened read = open_brdf(scratch / "x.json");
  ExportNotes notes;
  const auto sampled = samples_to_write(model, options, notes);
  REQUIRE(read.dataset->size() == sampled->size());
  CHECK(read.dataset->f == sampled->f);
  CHECK(read.dataset->channels == rgb_channels());
  CHECK_FALSE(read.simulated);
}

TEST_CASE("Uncertainties are divided by their coverage factor; without one the file is refused") {
  const std::string percent = R"("BRDF": {"unit": "sr^-1", "values": [0.5]}, "uBRDF": {"unit": "%", "values": [4])";
  CHECK(faults_of([&] { open(with(percent + "}")); }).find("--assume coverage_factor=1") != std::string::npos);
  ReadOptions options;
  options.assume["coverage_factor"] = "2";
  CHECK(open(with(percent + "}"), options).dataset->u[0][0] == Approx(0.01).epsilon(1e-15));
  CHECK(open(with(percent + R"(, "comments": "expanded, k = 2.5"})")).dataset->u[0][0] == Approx(0.008).epsilon(1e-15));
  CHECK(open(with(percent + R"(, "comments": "expanded, k=2, dark = 3"})")).dataset->u[0][0] == Approx(0.01).epsilon(1e-15));
  options.assume["coverage_factor"] = "two";
  CHECK(faults_of([&] { open(with(percent + "}"), options); }).find("usage|") == 0);

  const Opened common = open(with(R"("BRDF": {"unit": "1/sr", "values": [0.5], "uncertainty": {"value": 0.03, "unit": "1/sr"},
    "comments": "K=3"})"));
  CHECK(common.dataset->u[0][0] == Approx(0.01).epsilon(1e-15));
  CHECK_FALSE(open(with(R"("BRDF": {"unit": "1/sr", "values": [0.5]})")).dataset->has_uncertainty());
}

TEST_CASE("Radians, micrometres, polarisation and Stokes vectors are understood") {
  const Opened read = open(with(R"("BRDF": {"unit": "1/sr", "values": [0.5]}, "wavelength_i": {"unit": "μm", "values": [0.55]},
    "polarization_i": {"notation": "inStokes", "values": [[1, -1, 0, 0]]}, "polarization_r": {"notation": "sp", "values": ["u"]})"));
  const Channel& channel = read.dataset->channels[0];
  CHECK(*channel.wavelength_in_nm == Approx(550));
  CHECK(*channel.polarisation_in == "1 -1 0 0");
  CHECK(*channel.polarisation_out == "u");
  CHECK(read.dataset->angles[0].theta_o.radians() == 0.5);
  CHECK(read.info[4].second.find("faults, the first") != std::string::npos);
}

TEST_CASE("A text in the metadata that is too long hides no fault of the data") {
  const std::string text(20000, 'x');
  const std::string faults =
      faults_of([&] { open(R"({"metadata": {"timestamp": "", "provenance": {}, "description": ")" + text + "\"}}"); });
  CHECK(faults.find("no member \"data\"") != std::string::npos);
}

TEST_CASE("Every fault of the data is named at once, by its place") {
  const std::string faults = faults_of([] {
    open(with(R"("BRDF": {"unit": "1/sr", "values": [0.5, -1]}, "uBRDF": {"unit": "1/sr"}, "wavelength_i": {"unit": "m", "values": [1]})"));
  });
  for (const char* where : {"#/data/BRDF/values/1|", "#/data/uBRDF|", "#/data/wavelength_i/unit|"}) {
    INFO(where << " in " << faults);
    CHECK(faults.find(where) != std::string::npos);
  }
  const std::string lengths = faults_of([] { open(with(R"("BRDF": {"unit": "1/sr", "values": [0.5, 1]})")); });
  CHECK(lengths.find("#/data/theta_i/values|1 values|2, as BRDF has") != std::string::npos);
}

TEST_CASE("No damaged file of this format does more than raise an error") {
  const test::TemporaryFolder scratch;
  write_bird(measured(), scratch / "seed", {});
  const std::string seed = read_file(scratch / "seed");
  const std::string letters = std::string("0123456789.-+eE\"{}[]:, \nnull") + std::string("\0\xff", 2);
  const auto [read, refused] = test::read_damaged({seed}, letters, 20260706, 1500, [&](const std::string& text) {
    const Opened opened = open_bird(scratch.file("damaged.json", text), {});
    opened.dataset->require_consistent();
    REQUIRE(opened.dataset->size() > 0);
  });
  CHECK(read > 100);
  CHECK(refused > 300);
}
