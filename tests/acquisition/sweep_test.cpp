// SPDX-License-Identifier: BSD-3-Clause
// Sweeps of the embedded simulated bench over real sockets.
#include "acquisition/sweep.hpp"

#include <chrono>
#include <iostream>

#include "tests/acquisition/test_bench.hpp"
#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;
using namespace gonio::acquisition::test;

namespace {

std::map<std::pair<std::int64_t, int>, Reading> accepted(const Run& run) {
  std::map<std::pair<std::int64_t, int>, Reading> result;
  for (const Reading& r : run.readings()) {
    if (r.good && !result.emplace(std::pair{r.step, r.repeat}, r).second) FAIL("step " << r.step << " was accepted twice");
  }
  return result;
}

}  // namespace

TEST_CASE("A sweep of the ideal bench reads the model at the read-back pose") {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  const SweepPlan plan = small_plan(bench, 60);
  Run run = Run::create(folder / "run.gonio", bench, {}, plan);
  const SweepResult result = sweep_embedded(run, bench, plan);
  CHECK(result.measured == plan.steps.size());
  CHECK(run.accepted_steps().size() == plan.steps.size());

  const auto kinematics = make_kinematics(bench);
  const auto readings = accepted(run);
  constexpr double rounding_only = 1e-14, half_a_count_deg = 0.5000001e-6;
  for (const PlanStep& step : plan.steps) {
    const Reading& r = readings.at({step.number, 0});
    const Pose pose = kinematics->pose(r.axes);
    for (std::size_t k = 0; k < r.axes.size(); ++k) CHECK(std::abs(r.axes[k] - step.axes[k]) <= half_a_count_deg);
    const double f = step.kind == StepKind::dark        ? 0
                     : step.kind == StepKind::reference ? bench.reference.f_per_sr
                                                        : sample()->eval(pose).front();
    const double expected = bench.source_power_w * f * pose.theta_o.cos();
    CHECK(std::abs(r.signal - expected) <= rounding_only * expected);
    CHECK(r.exposure_s == step.exposure_s);
  }
}

TEST_CASE("The same seed gives the same file, another seed another") {
  TemporaryFolder folder;
  Bench bench = ideal_bench();
  bench.simulated.motion = true;
  bench.simulated.read_noise = 1e-9;
  bench.simulated.shot_counts_per_unit = 1e12;
  bench.simulated.drift_per_hour = 0.01;
  const SweepPlan plan = small_plan(bench, 30);
  std::vector<std::string> hashes;
  for (const std::uint64_t seed : {7u, 7u, 8u}) {
    bench.seed = seed;
    const auto path = folder / ("run" + std::to_string(hashes.size()) + ".gonio");
    {
      Run run = Run::create(path, bench, {}, plan);
      sweep_embedded(run, bench, plan);
    }
    CHECK_FALSE(std::filesystem::exists(path.string() + "-wal"));
    hashes.push_back(sha256_of_file(path));
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] != hashes[2]);
}

TEST_CASE("Ten hours and 2600 points are swept on the virtual clock") {
  TemporaryFolder folder;
  const std::filesystem::path examples = std::filesystem::path(GONIO_SOURCE_DIR) / "data-schemas/examples/valid";
  Bench bench = load_bench(examples / "demo.bench.json");
  bench.range_w = 1000;
  const PlanRequest request = load_plan(examples / "ten-hours.plan.json");
  const SweepPlan plan = make_plan(request, bench);
  Run run = Run::create(folder / "run.gonio", bench, request, plan);
  const auto begin = std::chrono::steady_clock::now();
  const SweepResult result = sweep_embedded(run, bench, plan);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  CHECK(result.measured > 2000);
  CHECK(result.bench_s > 8 * 3600);
  std::cout << result.measured << " steps, " << result.bench_s / 3600 << " h of bench time, " << wall.count() << " s wall\n";
}

TEST_CASE("A request to stop ends the sweep with the shutter closed, and the sweep can be resumed") {
  TemporaryFolder folder;
  Bench bench = ideal_bench();
  bench.simulated.motion = true;
  const SweepPlan plan = small_plan(bench, 30);
  const auto path = folder / "run.gonio";
  std::atomic<bool> stop = false;
  SweepOptions options;
  options.stop = &stop;
  std::size_t last_done = 0;
  options.progress = [&](const SweepProgress& p) {
    CHECK(p.done == last_done + 1);
    CHECK(p.total == plan.steps.size());
    CHECK(p.eta_bench_s >= 0);
    last_done = p.done;
    stop = p.done == 11;
  };
  {
    Run run = Run::create(path, bench, {}, plan);
    EmbeddedBench embedded(bench);
    ConnectedBench devices = connect(embedded.bench, embedded.clock, &stop);
    bool interrupted = false;
    try {
      sweep(run, plan, *devices.gantry, *devices.detector, *devices.source, *devices.clock, options);
    } catch (const Error& e) {
      interrupted = e.kind() == ErrorKind::interrupted;
    }
    CHECK(interrupted);
    CHECK(run.accepted_steps().size() == 11);
    CHECK(run.events().back().kind == "stop");
    CHECK(run.events().back().text.starts_with("shutter closed, arms at rest"));
  }
  Run run = Run::open(path, true);
  const SweepResult rest = sweep_embedded(run, bench, plan);
  CHECK(rest.skipped == 11);
  CHECK(accepted(run).size() == plan.steps.size());
  BenchTime last = 0;
  for (const Reading& r : run.readings()) {
    CHECK(r.time >= last);
    last = r.time;
  }
}

TEST_CASE("A sweep refuses a plan that is not the run's") {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  Run run = Run::create(folder / "run.gonio", bench, {}, small_plan(bench, 5));
  CHECK_THROWS_AS(sweep_embedded(run, bench, small_plan(bench, 6)), Error);
}

TEST_CASE("A signal beyond the range is retried, never stored, and ends the sweep with the arms stopped") {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  const SweepPlan plan = small_plan(bench, 3);
  Run run = Run::create(folder / "run.gonio", bench, {}, plan);
  EmbeddedBench embedded(bench);
  ConnectedBench devices = connect(embedded.bench, embedded.clock);
  class Narrow final : public Detector {
   public:
    explicit Narrow(Detector& detector) : detector_(detector) {}
    std::string identity() override { return detector_.identity(); }
    void configure(double wavelength_nm, double, double exposure_s) override { detector_.configure(wavelength_nm, 1e-5, exposure_s); }
    double read(double exposure_s) override { return detector_.read(exposure_s); }

   private:
    Detector& detector_;
  } narrow(*devices.detector);
  CHECK_THROWS_AS(sweep(run, plan, *devices.gantry, narrow, *devices.source, *devices.clock, {}), Error);
  for (const Reading& r : run.readings()) CHECK(r.signal < 1e-5);
  CHECK(std::ranges::count_if(run.events(), [](const RunEvent& e) { return e.kind == "retry"; }) == 3);
}
