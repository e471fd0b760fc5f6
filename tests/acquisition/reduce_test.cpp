// SPDX-License-Identifier: BSD-3-Clause
// Reduction against the model that the readings were made from.
#include "acquisition/reduce.hpp"

#include <cmath>
#include <functional>
#include <random>

#include "brdf/error.hpp"
#include "tests/acquisition/test_bench.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;

namespace {

constexpr unsigned seed = 20260707;
constexpr double last_digits = 1e-12;  // relative: ten times the roundings of the equation, a hundredth of a part in 1e10

Bench demo_bench() { return load_bench(std::filesystem::path(GONIO_SOURCE_DIR) / "data-schemas/examples/valid/demo.bench.json"); }

PlanRequest small_request() {
  PlanRequest request;
  request.theta_i_deg = {10, 45, 65};
  request.phi_i_deg = {0};
  request.theta_o_deg = {5, 25, 45, 65, 85};
  request.phi_o_deg = {0, 90, 180};
  request.rotations = 2;
  return request;
}

/// Readings of a bench that obeys the measurement equation, a second apart; `noise(kind)` is added to each.
struct Instrument {
  Bench bench;
  SweepPlan plan;
  double dark_w = 2e-9, drift_per_s = 0;
  double (*dark_course)(double) = [](double) { return 0.0; };
  std::function<double(double)> noise = [](double) { return 0.0; };

  double factor(const Pose& pose) const {
    const double a = *bench.apertures.receiver_half_angle_deg;
    return bench.source_power_w * (a == 0 ? pose.theta_o.cos() : projected_solid_angle(pose.theta_o, degrees(a)));
  }

  std::vector<Reading> readings() const {
    const auto kinematics = make_kinematics(bench);
    const auto brdf = acquisition::test::sample();
    std::vector<Reading> out;
    double time = 0;
    for (const PlanStep& step : plan.steps) {
      if (step.state != StepState::ok) continue;
      for (int repeat = 0; repeat < readings_at(step.kind, bench); ++repeat) {
        Reading r;
        r.step = step.number;
        r.repeat = repeat;
        r.time = static_cast<BenchTime>(++time * static_cast<double>(second));
        r.exposure_s = step.exposure_s;
        r.range_w = bench.range_w;
        for (std::size_t a = 0; a < bench.axes.size(); ++a) {
          r.counts.push_back(bench.axes[a].counts(step.axes[a]));
          r.axes.push_back(bench.axes[a].degrees(r.counts.back()));
        }
        const Pose pose = kinematics->pose(r.axes);
        double light = 0;
        if (step.kind == StepKind::reference) light = bench.reference.f_per_sr * factor(pose);
        if (step.kind == StepKind::sample) light = brdf->eval(pose).front() * factor(pose);
        r.signal = light * (1 + drift_per_s * time) + dark_w + dark_course(time);
        r.signal += noise(r.signal);
        out.push_back(r);
      }
    }
    return out;
  }
};

Instrument instrument(const Bench& bench, const PlanRequest& request = small_request()) {
  Instrument i;
  i.bench = bench;
  i.plan = make_plan(request, bench);
  return i;
}

double worst_relative(const Dataset& data) {
  const auto brdf = acquisition::test::sample();
  double worst = 0;
  for (std::size_t k = 0; k < data.size(); ++k) worst = std::max(worst, std::abs(data.f[0][k] / brdf->eval(data.angles[k]).front() - 1));
  return worst;
}

std::string refused(const Bench& bench, const std::vector<PlanStep>& steps, const std::vector<Reading>& readings) {
  try {
    reduce(bench, steps, readings);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    return error.faults().at(0).found;
  }
  return "taken";
}

const CorrelatedComponent* component(const Dataset& data, const std::string& name) {
  for (const auto& c : data.correlated)
    if (c.name == name) return &c;
  return nullptr;
}

}  // namespace

TEST_CASE("without noise the reduction gives the model at the read-back pose back") {
  for (const Bench& bench : {acquisition::test::ideal_bench(), demo_bench()}) {
    Instrument i = instrument(bench);
    i.dark_w = 0;
    const Dataset data = reduce(i.bench, i.plan.steps, i.readings());
    CHECK(data.size() == i.plan.count(StepKind::sample, StepState::ok));
    CHECK(worst_relative(data) < last_digits);
    CHECK(data.simulated);
    for (const double u : data.u[0]) CHECK(u > 0);
  }
}

TEST_CASE("dark and linear drift of dark and source are taken out") {
  Instrument i = instrument(demo_bench());
  i.drift_per_s = 1e-5;
  CHECK(worst_relative(reduce(i.bench, i.plan.steps, i.readings())) < 1e-4);  // linear in time but for the visit's own course
  i.bench.reference.interval_s = i.bench.dark_interval_s = 5;
  i.plan = make_plan(small_request(), i.bench);
  i.dark_course = [](double t) { return 1e-12 * t; };
  CHECK(worst_relative(reduce(i.bench, i.plan.steps, i.readings())) < 1e-4);
  // Left in, the same dark spoils the darkest samples.
  auto readings = i.readings();
  for (Reading& r : readings)
    if (i.plan.steps[static_cast<std::size_t>(r.step)].kind == StepKind::dark) r.signal = 0;
  CHECK(worst_relative(reduce(i.bench, i.plan.steps, readings)) > 0.01);
}

TEST_CASE("a swept ideal bench over Modbus and SCPI reduces to the model at the read-back pose, asked pose within half a count") {
  const acquisition::test::TemporaryFolder folder;
  const Bench bench = acquisition::test::ideal_bench();
  PlanRequest request =
      plan_from(load_plan(std::filesystem::path(GONIO_SOURCE_DIR) / "data-schemas/examples/valid/demo.plan.json").document);
  const SweepPlan plan = make_plan(request, bench);
  Run run = Run::create(folder / "run.gonio", bench, request, plan);
  acquisition::test::sweep_embedded(run, bench, plan);
  const Dataset data = reduce(run);
  CHECK(data.size() == plan.count(StepKind::sample, StepState::ok));
  CHECK(data.size() > 1000);
  CHECK(worst_relative(data) < last_digits);
  CHECK(data.masked.blocked == plan.count(StepKind::sample, StepState::masked));
  const double half_a_count = 0.5e-6 * (1 + 1e-6);
  for (std::size_t k = 0; k < data.size(); ++k) {
    CHECK(std::abs(data.angles[k].theta_i.degrees() - data.extra.at("commanded_theta_i_deg")[k]) <= half_a_count);
    CHECK(std::abs(data.angles[k].theta_o.degrees() - data.extra.at("commanded_theta_o_deg")[k]) <= half_a_count);
    CHECK(std::abs(std::remainder(data.angles[k].phi_i.degrees() - data.extra.at("commanded_phi_i_deg")[k], 360)) <= half_a_count);
  }
  CHECK(data.provenance.at("bench_sha256") == bench.sha256);
  CHECK(data.provenance.at("plan_sha256") == request.sha256);
}

TEST_CASE("the stated u is the scatter of the samples") {
  std::mt19937_64 random(seed);
  Instrument i = instrument(demo_bench());
  const double read = *i.bench.noise->read_w, k = *i.bench.noise->electrons_per_joule;
  std::normal_distribution<double> normal(0, 1);
  i.noise = [&](double s) { return std::sqrt(read * read + s / (k * 0.1)) * normal(random); };
  const auto brdf = acquisition::test::sample();
  double squares = 0;
  std::size_t n = 0;
  for (int round = 0; round < 40; ++round) {
    const Dataset data = reduce(i.bench, i.plan.steps, i.readings());
    for (std::size_t j = 0; j < data.size(); ++j) {
      const double truth = brdf->eval(data.angles[j]).front(), z = (data.f[0][j] - truth) / data.u[0][j];
      squares += z * z;
      ++n;
      CHECK(data.extra.at("var_read")[j] > 0);
      CHECK(data.extra.at("var_read")[j] < data.u[0][j] * data.u[0][j]);
    }
  }
  INFO("seed " << seed << ", pulls " << std::sqrt(squares / static_cast<double>(n)));
  // The shared noise of dark and reference adds a little to the pulls, and it is small beside a single reading's.
  CHECK(std::sqrt(squares / static_cast<double>(n)) > 0.95);
  CHECK(std::sqrt(squares / static_cast<double>(n)) < 1.08);
}

TEST_CASE("noise that is not stated is estimated, and unknown where it cannot be") {
  std::mt19937_64 random(seed);
  Instrument i = instrument(demo_bench());
  const double read = *i.bench.noise->read_w, k = *i.bench.noise->electrons_per_joule;
  std::normal_distribution<double> normal(0, 1);
  i.noise = [&](double s) { return std::sqrt(read * read + s / (k * 0.1)) * normal(random); };
  const auto readings = i.readings();
  const Dataset stated = reduce(i.bench, i.plan.steps, readings);
  i.bench.noise.reset();
  const Dataset estimated = reduce(i.bench, i.plan.steps, readings);
  CHECK(estimated.provenance.at("noise") == "estimated from repeated readings");
  for (std::size_t j = 0; j < stated.size(); ++j) CHECK(estimated.u[0][j] / stated.u[0][j] == Approx(1).epsilon(0.5));
  std::vector<Reading> single;
  for (const Reading& r : readings)
    if (r.repeat == 0) single.push_back(r);
  const Dataset unknown = reduce(i.bench, i.plan.steps, single);
  CHECK(unknown.provenance.at("noise") == "unknown");
  for (const double u : unknown.u[0]) CHECK(std::isnan(u));
}

TEST_CASE("shared uncertainties are named components") {
  Instrument i = instrument(demo_bench());
  i.bench.correlated["stray_light"] = 0.001;
  const Dataset data = reduce(i.bench, i.plan.steps, i.readings());
  REQUIRE(component(data, "certificate"));
  CHECK(component(data, "certificate")->u == 0.004);
  CHECK(component(data, "certificate")->sensitivity.empty());
  REQUIRE(component(data, "stray_light"));
  REQUIRE(component(data, "reference_noise_1"));
  REQUIRE(component(data, "reference_noise_2"));
  CHECK(component(data, "reference_noise_1")->u < 0.002);
  // A sample takes its white from the visits around it: a white that reads 1 % more everywhere makes f 1 % less.
  for (std::size_t k = 0; k < data.size(); ++k) {
    double sum = 0;
    for (const CorrelatedComponent& c : data.correlated)
      if (c.name.starts_with("reference_noise_")) sum += c.sensitivity[k];
    CHECK(sum == Approx(-1).epsilon(1e-12));
  }
  REQUIRE(component(data, "dark_noise"));
  REQUIRE(component(data, "dark_noise")->sensitivity.size() == data.size());
  CHECK(component(reduce(acquisition::test::ideal_bench(), instrument(acquisition::test::ideal_bench()).plan.steps,
                         instrument(acquisition::test::ideal_bench()).readings()),
                  "certificate") == nullptr);
}

TEST_CASE("the sensitivity to the dark is the derivative of ln f") {
  Instrument i = instrument(demo_bench());
  const Dataset data = reduce(i.bench, i.plan.steps, i.readings());
  auto readings = i.readings();
  const double step = 1e-13;
  for (Reading& r : readings)
    if (i.plan.steps[static_cast<std::size_t>(r.step)].kind == StepKind::dark) r.signal += step;
  const Dataset shifted = reduce(i.bench, i.plan.steps, readings);
  for (std::size_t k = 0; k < data.size(); ++k)
    CHECK(std::log(shifted.f[0][k] / data.f[0][k]) / step ==
          Approx(component(data, "dark_noise")->sensitivity[k]).epsilon(1e-3).margin(1e3));
}

TEST_CASE("a source that drifts in a curve is a component") {
  Instrument i = instrument(demo_bench());
  i.bench.reference.interval_s = 20;
  i.plan = make_plan(small_request(), i.bench);
  auto readings = i.readings();
  for (Reading& r : readings) r.signal *= 1 + 0.02 * std::sin(1e-2 * static_cast<double>(r.time) / static_cast<double>(second));
  const Dataset data = reduce(i.bench, i.plan.steps, readings);
  REQUIRE(component(data, "drift"));
  CHECK(component(data, "drift")->u > 1e-4);
  CHECK(component(data, "drift")->u < 0.02);
}

TEST_CASE("the last good attempt counts and refused readings do not") {
  Instrument i = instrument(demo_bench());
  auto readings = i.readings();
  std::vector<Reading> more;
  for (const Reading& r : readings) {
    Reading wrong = r;
    wrong.signal *= 3;
    more.push_back(wrong);  // attempt 0, good, but taken again
    Reading again = r;
    again.attempt = 1;
    more.push_back(again);
    wrong.attempt = 2;
    wrong.good = false;
    wrong.reason = "saturated";
    more.push_back(wrong);
  }
  CHECK(worst_relative(reduce(i.bench, i.plan.steps, more)) < last_digits);
}

TEST_CASE("masked and missing points are counted, not samples") {
  Instrument i = instrument(demo_bench());
  auto readings = i.readings();
  const std::size_t all = reduce(i.bench, i.plan.steps, readings).size();
  REQUIRE(i.plan.count(StepKind::sample, StepState::masked) > 0);
  readings.erase(std::find_if(readings.begin(), readings.end(),
                              [&](const Reading& r) { return i.plan.steps[static_cast<std::size_t>(r.step)].kind == StepKind::sample; }));
  const Dataset data = reduce(i.bench, i.plan.steps, readings);
  CHECK(data.size() == all - 1);
  CHECK(data.masked.missing == 1);
  CHECK(data.masked.blocked == i.plan.count(StepKind::sample, StepState::masked));
}

TEST_CASE("what is needed and not there is refused by name") {
  const Instrument i = instrument(demo_bench());
  const auto readings = i.readings();
  const auto without = [&](StepKind kind) {
    std::vector<Reading> out;
    for (const Reading& r : readings)
      if (i.plan.steps[static_cast<std::size_t>(r.step)].kind != kind) out.push_back(r);
    return out;
  };
  CHECK(refused(i.bench, i.plan.steps, without(StepKind::dark)) == "no dark reading of its exposure and range");
  CHECK(refused(i.bench, i.plan.steps, without(StepKind::reference)) == "no good reading of the reference");
  CHECK(refused(i.bench, i.plan.steps, without(StepKind::sample)) == "no good reading of the sample");
  CHECK(refused(i.bench, i.plan.steps, {}) == "no good reading of the reference");
  auto changed = readings;
  for (Reading& r : changed) r.signal = 1e-9;
  CHECK(refused(i.bench, i.plan.steps, changed) == "a signal that is not above the dark");
  changed = readings;
  changed[5].signal = std::nan("");
  CHECK(refused(i.bench, i.plan.steps, changed) == "signal nan");
  changed = readings;
  changed[5].axes.pop_back();
  CHECK(refused(i.bench, i.plan.steps, changed) == "3 axis angles");
  changed = readings;
  for (Reading& r : changed)
    if (i.plan.steps[static_cast<std::size_t>(r.step)].kind == StepKind::sample) r.range_w = 1e-6;
  CHECK(refused(i.bench, i.plan.steps, changed) == "no dark reading of its exposure and range");
}
