// SPDX-License-Identifier: BSD-3-Clause
// Bench files: what they say, and what is refused with which words.
#include "acquisition/bench.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <random>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "tests/acquisition/mutated_json.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;
using gonio::test::edited;
using gonio::test::removed;

namespace {

const std::filesystem::path examples = std::filesystem::path(GONIO_SOURCE_DIR) / "data-schemas/examples";

Json demo() { return parse_json(example_text("demo.bench.json"), "demo"); }

using Places = std::vector<std::string>;

Places faults(const Json& document, const std::filesystem::path& folder = ".") {
  Places places;
  try {
    bench_from(document, folder, "b");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    for (const Fault& fault : error.faults()) places.push_back(fault.where);
  }
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace

TEST_CASE("the example benches load") {
  for (const char* name : {"demo.bench.json", "ideal.bench.json", "stanford.bench.json"}) {
    INFO(name);
    const Bench bench = load_bench(examples / "valid" / name);
    CHECK(bench.axes.size() == 4);
    CHECK(bench.kinematics == "spherical-gantry");
    CHECK(bench.sha256 == sha256_of_file(examples / "valid" / name));
    CHECK(bench.apertures.receiver_half_angle_deg.has_value());
  }
}

TEST_CASE("the demo bench says what its file says") {
  const Bench bench = load_bench(examples / "valid/demo.bench.json");
  CHECK(bench.is_simulated);
  CHECK(bench.seed == 1);
  CHECK(bench.axes[1].name == "light");
  CHECK(bench.axes[1].speed_deg_per_s == 15);
  CHECK(bench.axes[1].profile.name == "cia402");
  CHECK(bench.reference.pose.theta_o.degrees() == 45);
  CHECK(bench.reference.readings == 40);
  CHECK(bench.dark_readings == 20);
  REQUIRE(bench.noise.has_value());
  CHECK(bench.noise->read_w == 1.5e-10);
  CHECK(bench.simulated.motion);
  CHECK(bench.simulated.read_noise == 1.5e-10);
  CHECK(bench.simulated.certificate_error);
  CHECK(bench.simulated.meter_digits == 7);
  REQUIRE(bench.simulated.sample.has_value());
  CHECK(bench.simulated.sample->model == "blinn-phong");
  CHECK(bench.simulated.sample->parameters.at("s") == 60);
}

TEST_CASE("an effect that is not named is off") {
  const Bench bench = load_bench(examples / "valid/ideal.bench.json");
  CHECK(bench.is_simulated);
  CHECK_FALSE(bench.simulated.motion);
  CHECK_FALSE(bench.simulated.read_noise.has_value());
  CHECK_FALSE(bench.simulated.shot_counts_per_unit.has_value());
  CHECK_FALSE(bench.simulated.dark.has_value());
  CHECK_FALSE(bench.simulated.drift_per_hour.has_value());
  CHECK_FALSE(bench.simulated.certificate_error);
  CHECK(bench.simulated.meter_digits == 17);
}

TEST_CASE("a real bench is not simulated and unknown polarisation stays unknown") {
  const Bench bench = load_bench(examples / "valid/stanford.bench.json");
  CHECK_FALSE(bench.is_simulated);
  CHECK_FALSE(bench.polarisation_source.has_value());
  CHECK_FALSE(bench.noise.has_value());
  CHECK(bench.correlated.at("linearity") == 0.002);
}

TEST_CASE("positions are counts from the zero in the sense of the drive") {
  Axis axis;
  axis.counts_per_deg = 8000;
  axis.zero_offset_deg = 90;
  axis.sign = -1;
  CHECK(axis.counts(90) == 0);
  CHECK(axis.counts(91) == -8000);
  CHECK(axis.degrees(-8000) == 91);
  axis = Axis{};
  CHECK(axis.counts(-180) == -180000000);
  CHECK(axis.degrees(axis.counts(12.345678)) == 12.345678);
}

TEST_CASE("a bench read again from its document is the same, without its files") {
  const Bench bench = load_bench(examples / "valid/stanford.bench.json");
  CHECK(bench.document.at("axes")[0].at("profile").is_object());
  const Bench again = bench_from(bench.document, "/nowhere");
  CHECK(again.axes[0].profile.name == "cia402");
  CHECK(again.document == bench.document);
}

TEST_CASE("nine faults are nine lines with JSON pointers") {
  try {
    load_bench(examples / "invalid/nine-faults.bench.json");
    FAIL("the file was taken");
  } catch (const Error& error) {
    Places places;
    for (const Fault& fault : error.faults()) places.push_back(fault.where.substr(fault.where.find('#')));
    std::sort(places.begin(), places.end());
    INFO(error.what());
    CHECK(places == Places{"#", "#/axes/0/sign", "#/axes/1/unit", "#/axes/2", "#/colour", "#/connections/modbus/port",
                           "#/detector/exposure_s", "#/geometry/head_radius_m", "#/reference/pose/theta_o_deg"});
  }
}

TEST_CASE("what a schema cannot say is refused where it stands") {
  const Json good = demo();
  CHECK(faults(good).empty());
  CHECK(faults(edited(good, {"axes", "1", "lower_deg"}, 180)) == Places{"b#/axes/1/lower_deg"});
  CHECK(faults(edited(good, {"axes", "1", "unit"}, 1)) == Places{"b#/axes/1/unit"});
  CHECK(faults(edited(good, {"axes", "1", "unit"}, 10)) == Places{"b#/axes/1/unit"});
  CHECK(faults(edited(good, {"axes", "0", "counts_per_deg"}, 1e8)) ==
        Places{"b#/axes/0/lower_deg", "b#/axes/0/speed_deg_per_s", "b#/axes/0/upper_deg"});
  CHECK(faults(edited(good, {"axes", "0", "tolerance_deg"}, 1e-5)) == Places{"b#/axes/0/tolerance_deg"});
  CHECK(faults(edited(good, {"axes", "0", "name"}, "light")) == Places{"b#/axes/1/name"});
  CHECK(faults(edited(good, {"geometry", "field_diameter_m"}, 0.003)) == Places{"b#/geometry/field_diameter_m"});
  CHECK(faults(edited(good, {"geometry", "head_radius_m"}, 0.8)) == Places{"b#/geometry/head_radius_m"});
  CHECK(faults(edited(good, {"simulated", "sample", "file"}, "x.csv")) == Places{"b#/simulated/sample"});
  CHECK(faults(removed(good, {"simulated"})) == Places{"b#/connections/modbus/port", "b#/connections/scpi/port"});
  CHECK(faults(edited(good, {"reference", "pose", "theta_o_deg"}, 1)) == Places{"b#/reference/pose"});
  CHECK(faults(edited(good, {"axes", "0", "profile"}, "missing.json")).size() == 1);
}

TEST_CASE("axes of other kinematics are refused") {
  CHECK(faults(edited(demo(), {"axes", "0", "name"}, "turntable")) == Places{"b#/axes/0/name"});
}

TEST_CASE("a fault of the schema does not hide the others") {
  Json document = edited(demo(), {"axes", "1", "lower_deg"}, 180);
  document = edited(document, {"detector", "exposure_s"}, 0);
  CHECK(faults(document) == Places{"b#/axes/1/lower_deg", "b#/detector/exposure_s"});
}

TEST_CASE("faults of a profile written into the bench file stand in the bench file") {
  Json profile = parse_json(axis_profile_text("cia402"), "cia402");
  profile.set("word_order", "middle-first");
  CHECK(faults(edited(demo(), {"axes", "2", "profile"}, profile)) == Places{"b#/axes/2/profile/word_order"});
}

TEST_CASE("a mutated bench file is taken or refused with an input error, nothing else") {
  const std::string text(example_text("demo.bench.json"));
  const std::size_t refused =
      gonio::test::count_refused(text, 4000, 20260703, [](const Json& document) { bench_from(document, ".", "b"); });
  CHECK(refused > 2000);
  CHECK(refused < 4000);
}
