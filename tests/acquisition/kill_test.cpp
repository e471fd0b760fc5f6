// SPDX-License-Identifier: BSD-3-Clause
// A sweeping process that is killed at any instant loses nothing and repeats nothing; its bench lives in a process of its own.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include "acquisition/sweep.hpp"
#include "tests/acquisition/bench_process.hpp"
#include "tests/acquisition/test_bench.hpp"
#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;
using namespace gonio::acquisition::test;

namespace {

/// Motion and noise, but no drift: then a reading does not depend on when it is taken.
Bench noisy_bench() {
  Bench bench = ideal_bench();
  bench.simulated.motion = true;
  bench.simulated.read_noise = 1e-9;
  bench.simulated.shot_counts_per_unit = 1e12;
  return bench;
}

/// Starts or resumes the sweep in a new process.
pid_t start_sweep(const std::filesystem::path& path, const Bench& bench, const SweepPlan& plan) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  try {
    Run run = std::filesystem::exists(path) ? Run::open(path, true) : Run::create(path, bench, {}, plan);
    ConnectedBench devices = connect(bench);
    sweep(run, plan, *devices.gantry, *devices.detector, *devices.source, *devices.clock, {});
  } catch (const std::exception& e) {
    std::fprintf(stderr, "sweep: %s\n", e.what());
    _exit(5);
  }
  _exit(0);
}

bool completes(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Everything about the readings of a run that must not depend on interruptions, in the order of the plan.
using Values = std::vector<std::tuple<std::int64_t, int, int, double, std::vector<std::int64_t>>>;
Values values(const std::filesystem::path& path) {
  Values v;
  for (const Reading& r : Run::open(path).readings()) v.emplace_back(r.step, r.repeat, r.attempt, r.signal, r.counts);
  std::ranges::sort(v);
  return v;
}

}  // namespace

TEST_CASE("A sweep killed at 100 random instants resumes to the values of an uninterrupted one, each step accepted once") {
  TemporaryFolder folder;
  const BenchProcess process(noisy_bench());
  const SweepPlan plan = small_plan(process.bench(), 24);

  const auto whole = folder / "whole.gonio";
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(completes(start_sweep(whole, process.bench(), plan)));
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
  const Values expected = values(whole);
  REQUIRE(expected.size() == plan.steps.size());

  constexpr unsigned seed = 20260701;
  constexpr int kills = 100;
  CAPTURE(seed, duration.count());
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> instant(0, duration.count());
  int killed = 0, partial = 0;
  for (int k = 0; killed < kills; ++k) {
    REQUIRE(k < 10 * kills);
    const auto path = folder / ("run" + std::to_string(k) + ".gonio");
    const pid_t pid = start_sweep(path, process.bench(), plan);
    // Not a wait for something to happen: the instant of the kill is what the test varies.
    std::this_thread::sleep_for(std::chrono::duration<double>(instant(random)));
    kill(pid, SIGKILL);
    if (completes(pid)) continue;
    ++killed;
    CAPTURE(k);
    if (std::filesystem::exists(path)) {
      const std::size_t kept = values(path).size();
      partial += kept > 0 && kept < expected.size();
    }
    REQUIRE(completes(start_sweep(path, process.bench(), plan)));
    CHECK(values(path) == expected);
    CHECK(Run::open(path).accepted_steps().size() == plan.steps.size());
    std::filesystem::remove(path);
  }
  CAPTURE(partial);
  CHECK(partial > kills / 10);  // else the kills did not fall into the sweep
}

TEST_CASE("A sweep killed again and again still ends with the values of an uninterrupted one") {
  TemporaryFolder folder;
  const BenchProcess process(noisy_bench());
  const SweepPlan plan = small_plan(process.bench(), 24);
  const auto whole = folder / "whole.gonio", path = folder / "run.gonio";
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(completes(start_sweep(whole, process.bench(), plan)));
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;

  std::mt19937 random(3);
  std::uniform_real_distribution<double> instant(0, 0.3 * duration.count());
  for (int k = 0; k < 30; ++k) {
    const pid_t pid = start_sweep(path, process.bench(), plan);
    std::this_thread::sleep_for(std::chrono::duration<double>(instant(random)));
    kill(pid, SIGKILL);
    completes(pid);
  }
  REQUIRE(completes(start_sweep(path, process.bench(), plan)));
  CHECK(values(path) == values(whole));
}
