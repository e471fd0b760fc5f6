// SPDX-License-Identifier: BSD-3-Clause
// Plans: which points, in which state, in which order, and how long it takes.
#include "acquisition/plan.hpp"

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "tests/acquisition/mutated_json.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;

namespace {

const std::filesystem::path examples = std::filesystem::path(GONIO_SOURCE_DIR) / "data-schemas/examples/valid";

Bench demo_bench() { return load_bench(examples / "demo.bench.json"); }
PlanRequest example(const std::string& name) { return load_plan(examples / (name + ".plan.json")); }

using Angles = std::array<double, 4>;
Angles angles(const Pose& pose) { return {pose.theta_i.degrees(), pose.phi_i.degrees(), pose.theta_o.degrees(), pose.phi_o.degrees()}; }

PlanRequest small() {
  PlanRequest request;
  request.theta_i_deg = {20, 40};
  request.phi_i_deg = {0};
  request.theta_o_deg = {10, 30, 50};
  request.phi_o_deg = {90, 180};
  return request;
}

std::vector<PlanStep> samples(const SweepPlan& plan) {
  std::vector<PlanStep> out;
  for (const PlanStep& step : plan.steps)
    if (step.kind == StepKind::sample) out.push_back(step);
  return out;
}

std::vector<std::string> places(const Json& document) {
  std::vector<std::string> out;
  try {
    plan_from(document, "p");
  } catch (const Error& error) {
    for (const Fault& fault : error.faults()) out.push_back(fault.where);
  }
  return out;
}

}  // namespace

TEST_CASE("a plan file gives its lists and ranges") {
  const PlanRequest request = example("demo");
  CHECK(request.theta_i_deg == std::vector<double>{10, 30, 50, 65});
  CHECK(request.theta_o_deg == std::vector<double>{5, 15, 25, 35, 45, 55, 65, 75, 82, 87});
  CHECK(request.phi_o_deg == std::vector<double>{0, 30, 60, 90, 120, 150, 180, 210, 240, 270, 300, 330});
  CHECK(request.density_points == 24);
  CHECK(request.rotations == 2);
  CHECK_FALSE(request.exposure_s.has_value());
  CHECK(example("ten-hours").exposure_s.has_value());
  CHECK(plan_from(request.document).theta_o_deg == request.theta_o_deg);
}

TEST_CASE("a range includes its end although steps are not exact in binary") {
  const Json plan = parse_json(R"({"name":"x","incident":{"theta_deg":[0],"phi_deg":[0]},
    "outgoing":{"theta_deg":{"from":0,"to":0.3,"step":0.1},"phi_deg":[0]}})",
                               "t");
  CHECK(plan_from(plan).theta_o_deg.size() == 4);
}

TEST_CASE("every contradiction of a plan file is named") {
  const Json good = example("demo").document;
  CHECK(places(good).empty());
  const Json backwards = parse_json(R"({"from": 80, "to": 0, "step": 5})", "t"),
             fine = parse_json(R"({"from": 0, "to": 80, "step": 0.00001})", "t");
  const Json wide = parse_json(R"({"from": 0, "to": 200, "step": 50})", "t");
  CHECK(places(test::edited(good, {"outgoing", "theta_deg"}, backwards)) == std::vector<std::string>{"p#/outgoing/theta_deg/from"});
  CHECK(places(test::edited(good, {"outgoing", "theta_deg"}, fine)) == std::vector<std::string>{"p#/outgoing/theta_deg/step"});
  CHECK(places(test::edited(good, {"incident", "theta_deg"}, wide)) == std::vector<std::string>{"p#/incident/theta_deg"});
  CHECK(places(test::edited(test::edited(good, {"outgoing", "theta_deg"}, backwards), {"incident", "theta_deg"}, wide)).size() == 2);
  CHECK(places(test::edited(test::edited(good, {"density", "points"}, 100000), {"rotations"}, 8)) == std::vector<std::string>{"p#"});
  CHECK(places(test::edited(good, {"rotations"}, 0)) == std::vector<std::string>{"p#/rotations"});
}

TEST_CASE("a mutated plan file is taken or refused with an input error, nothing else") {
  const std::string text = read_file(examples / "demo.plan.json");
  const Bench bench = demo_bench();
  const std::size_t refused = test::count_refused(text, 3000, 20260705, [&](const Json& document) {
    const PlanRequest request = plan_from(document, "p");
    const auto size = request.theta_i_deg.size() * request.phi_i_deg.size() *
                      (request.theta_o_deg.size() * request.phi_o_deg.size() + static_cast<std::size_t>(request.density_points));
    if (size * static_cast<std::size_t>(request.rotations) < 100) make_plan(request, bench);
  });
  CHECK(refused > 1000);
  CHECK(refused < 3000);
}

TEST_CASE("the grid is every incidence with every outgoing direction relative to it") {
  PlanRequest request = small();
  request.phi_i_deg = {0, 30};
  std::set<Angles> poses;
  for (const PlanStep& step : samples(make_plan(request, demo_bench()))) poses.insert(angles(step.pose));
  CHECK(poses.size() == 2 * 2 * 3 * 2);
  CHECK(poses.contains(Angles{20, 30, 50, 120}));
  CHECK(poses.contains(Angles{20, 30, 50, -150}));
}

TEST_CASE("the same pose twice is measured once") {
  PlanRequest request = small();
  request.theta_o_deg = {0, 30, -30};
  request.phi_o_deg = {0, 180, 360};
  // theta_o = 0 once, 30 at 0 and 180 once each per incidence.
  CHECK(samples(make_plan(request, demo_bench())).size() == 2 * 3);
}

TEST_CASE("reciprocity pairs coincide exactly, at every rotation, and name each other") {
  PlanRequest request = small();
  request.reciprocity_pairs = 5;
  request.rotations = 3;
  request.density_points = 7;
  const SweepPlan plan = make_plan(request, demo_bench());
  std::size_t partners = 0;
  for (const PlanStep& step : plan.steps) {
    if (step.partner < 0) continue;
    ++partners;
    const PlanStep& other = plan.steps[static_cast<std::size_t>(step.partner)];
    const Angles a = angles(step.pose), b = angles(other.pose);
    CHECK(b == Angles{a[2], a[3], a[0], a[1]});
    CHECK(other.partner == step.number);
    CHECK(other.rotation_deg == step.rotation_deg);
    CHECK(step.state == StepState::ok);
  }
  CHECK(partners == 2 * 5 * 3);
  CHECK(samples(plan).size() == (2 * (3 * 2 + 7) + 5) * 3);
}

TEST_CASE("without partners asked for there are none by chance unless the directions coincide") {
  PlanRequest request = small();
  for (const PlanStep& step : make_plan(request, demo_bench()).steps) CHECK(step.partner == -1);
  request.theta_i_deg = {20, 40};
  request.theta_o_deg = {20, 40};
  request.phi_o_deg = {180};
  request.phi_i_deg = {0, 180};
  std::size_t partners = 0;
  for (const PlanStep& step : make_plan(request, demo_bench()).steps) partners += step.partner >= 0;
  CHECK(partners == 8);  // 20/40 against 40/20 and the specular poses of the light on the one and the other side
}

TEST_CASE("a rotation keeps zenith angles and the difference of azimuths") {
  PlanRequest request = small();
  request.rotations = 4;
  std::map<std::array<double, 3>, std::set<double>> turns;
  for (const PlanStep& step : samples(make_plan(request, demo_bench()))) {
    const Angles a = angles(step.pose);
    turns[{a[0], a[2], std::remainder(a[3] - a[1], 360.0)}].insert(step.rotation_deg);
    CHECK(std::remainder(a[1] - step.rotation_deg, 360.0) == 0);
  }
  // The difference 180° comes as +180 and -180.
  std::size_t count = 0;
  for (const auto& [geometry, rotations] : turns) count += rotations.size();
  CHECK(count == 2 * 6 * 4);
  CHECK(turns[{20, 30, 90}] == std::set<double>{0, 90, 180, 270});
}

TEST_CASE("masked and unreachable points are in the plan with their reason and without axes") {
  Bench bench = demo_bench();
  bench.axes[3].lower_deg = -60;
  bench.axes[3].upper_deg = 60;
  PlanRequest request = small();
  request.theta_o_deg = {20, 70, 95};
  request.phi_o_deg = {0};
  const SweepPlan plan = make_plan(request, bench);
  CHECK(plan.count(StepKind::sample, StepState::ok) == 1);
  CHECK(plan.count(StepKind::sample, StepState::masked) == 3);  // 20/20 in the shadow, 95 below the horizon twice
  CHECK(plan.count(StepKind::sample, StepState::unreachable) == 2);
  for (const PlanStep& step : plan.steps) {
    CHECK(step.axes.empty() == (step.state != StepState::ok));
    CHECK(step.reason.empty() == (step.state == StepState::ok));
    if (step.state == StepState::unreachable) CHECK(step.reason == "axis detector_zenith: 70° is above its limit of 60°");
  }
}

TEST_CASE("the axes of every step realise its pose") {
  const Bench bench = demo_bench();
  const auto kinematics = make_kinematics(bench);
  for (const PlanStep& step : make_plan(example("demo"), bench).steps) {
    if (step.state != StepState::ok || step.kind != StepKind::sample) continue;
    const Pose back = kinematics->pose(step.axes);
    CHECK(angle_between(back.wi(), step.pose.wi()).radians() < 1e-13);
    CHECK(angle_between(back.wo(), step.pose.wo()).radians() < 1e-13);
  }
}

TEST_CASE("dark and reference stand at the start, at the end and at the stated intervals") {
  const Bench bench = demo_bench();
  const SweepPlan plan = make_plan(example("demo"), bench);
  REQUIRE(plan.steps.size() > 4);
  CHECK(plan.steps[0].kind == StepKind::dark);
  CHECK(plan.steps[1].kind == StepKind::reference);
  std::size_t last = plan.steps.size() - 1;
  while (plan.steps[last].state != StepState::ok) --last;
  CHECK(plan.steps[last].kind == StepKind::reference);
  CHECK(plan.steps[last - 1].kind == StepKind::dark);

  // Seconds between visits, from the moves of the plan itself.
  AxisAngles position(4, 0.0);
  double now = 0;
  std::map<StepKind, double> seen;
  for (const PlanStep& step : plan.steps) {
    if (step.state != StepState::ok) continue;
    const double move = move_time_s(position, step.axes, bench);
    now += move + (step.axes != position ? 0.2 : 0) + step.exposure_s * readings_at(step.kind, bench);
    position = step.axes;
    if (step.kind == StepKind::sample) continue;
    if (seen.contains(step.kind)) CHECK(now - seen[step.kind] < 600 + 20);  // the interval, one point and the way to the reference
    seen[step.kind] = now;
  }
  CHECK(now == Approx(plan.predicted_s).epsilon(0.01));
  CHECK(plan.count(StepKind::reference, StepState::ok) >= 3);
}

TEST_CASE("an exposure of its own brings darks of its own") {
  PlanRequest request = small();
  request.exposure_s = 0.5;
  const Bench bench = demo_bench();
  std::set<double> exposures;
  for (const PlanStep& step : make_plan(request, bench).steps) {
    if (step.kind == StepKind::dark) exposures.insert(step.exposure_s);
    if (step.kind == StepKind::sample) CHECK(step.exposure_s == 0.5);
    if (step.kind == StepKind::reference) CHECK(step.exposure_s == bench.exposure_s);
  }
  CHECK(exposures == std::set<double>{0.1, 0.5});
}

TEST_CASE("numbers are places in the order, and the same request gives the same plan") {
  const Bench bench = demo_bench();
  const SweepPlan plan = make_plan(example("demo"), bench), again = make_plan(example("demo"), bench);
  REQUIRE(plan.steps.size() == again.steps.size());
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    CHECK(plan.steps[k].number == static_cast<std::int64_t>(k));
    CHECK(plan.steps[k].axes == again.steps[k].axes);
  }
  PlanRequest other = example("demo");
  other.seed = 2;
  bool same = true;
  const SweepPlan differs = make_plan(other, bench);
  for (std::size_t k = 0; k < std::min(plan.steps.size(), differs.steps.size()); ++k)
    same = same && plan.steps[k].axes == differs.steps[k].axes;
  CHECK_FALSE(same);
}

TEST_CASE("the light moves only between incidences") {
  PlanRequest request = small();
  request.theta_o_deg = {5, 15, 25, 35, 45, 55, 65};
  request.phi_o_deg = {45, 90, 135, 180};
  std::size_t moves = 0;
  double light = 1e9;
  for (const PlanStep& step : samples(make_plan(request, demo_bench()))) {
    if (step.pose.theta_i.degrees() != light) ++moves;
    light = step.pose.theta_i.degrees();
  }
  CHECK(moves == 2);
}

TEST_CASE("2600 points take about ten hours of bench time, less than 1.1 of the least motion") {
  const Bench bench = demo_bench();
  const SweepPlan plan = make_plan(example("ten-hours"), bench);
  CHECK(samples(plan).size() == 2600);
  CHECK(plan.predicted_s > 9.5 * 3600);
  CHECK(plan.predicted_s < 10.5 * 3600);
  CHECK(plan.motion_s / plan.motion_bound_s >= 1);
  CHECK(plan.motion_s / plan.motion_bound_s < 1.1);
  CHECK(plan.travel_deg >= plan.travel_bound_deg);
}

TEST_CASE("without motion only exposures and settling take time") {
  const Bench bench = load_bench(examples / "ideal.bench.json");
  const SweepPlan plan = make_plan(small(), bench);
  CHECK(plan.predicted_s == Approx(0.1 * static_cast<double>(plan.steps.size())));
}

TEST_CASE("a move lasts as long as its slowest axis") {
  const Bench bench = demo_bench();
  CHECK(move_time_s({0, 0, 0, 0}, {0, 0, 0, 0}, bench) == 0);
  CHECK(move_time_s({0, 0, 0, 0}, {90, 0, 0, 0}, bench) == Approx(90.0 / 45 + 45.0 / 90));
  CHECK(move_time_s({0, 0, 0, 0}, {90, 75, 0, 0}, bench) == Approx(75.0 / 15 + 15.0 / 30));
  CHECK(move_time_s({0, 0, 0, 0}, {0, 0, 10, 0}, bench) == Approx(2 * std::sqrt(10.0 / 90)));
}
