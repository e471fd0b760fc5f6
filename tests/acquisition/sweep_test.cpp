// SPDX-License-Identifier: BSD-3-Clause
// Sweeps of the embedded simulated bench over real sockets.
#include "acquisition/sweep.hpp"

#include <chrono>
#include <numbers>

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
  for (const std::uint64_t seed : {7, 7, 8}) {
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

TEST_CASE("Ten hours and 2600 points take at most 10 s on the virtual clock and give the same file") {
  TemporaryFolder folder;
  Bench bench = ideal_bench();
  bench.simulated.motion = true;
  bench.simulated.read_noise = 1e-9;
  const SweepPlan plan = small_plan(bench, 2600, 12);
  const auto path = folder / "run.gonio";
  const auto begin = std::chrono::steady_clock::now();
  SweepResult result;
  {
    Run run = Run::create(path, bench, {}, plan);
    result = sweep_embedded(run, bench, plan);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  CAPTURE(wall.count(), result.bench_s);
  CHECK(result.bench_s > 10 * 3600 * 0.9);
  CHECK(result.measured == plan.steps.size());
  if (wall.count() > 10) WARN("took " << wall.count() << " s");
}
