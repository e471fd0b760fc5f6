// SPDX-License-Identifier: BSD-3-Clause
// The run store: what was acknowledged is there, what is not a run is refused.
#include "acquisition/run.hpp"

#include <fstream>
#include <random>

#include "tests/acquisition/lost_writes_vfs.hpp"
#include "tests/acquisition/test_bench.hpp"
#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;
using namespace gonio::acquisition::test;

namespace {

Reading reading_of(std::int64_t step) {
  Reading r;
  r.step = step;
  r.time = 7 * second + step;
  r.signal = 1.0 / (3.0 + static_cast<double>(step));
  r.exposure_s = 0.1;
  r.range_w = 1e-3;
  r.counts = {-1, 0, 2'000'000'000, 7};
  r.axes = {-1e-6, 0, 0.1, 1.0 / 3};
  return r;
}

ErrorKind kind_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    CHECK_FALSE(e.faults().empty());
    return e.kind();
  }
  FAIL("no error");
  return ErrorKind::internal;
}

/// How many of the acknowledged readings are there after the power has failed.
std::size_t kept_after_power_failure(bool synced, std::size_t acknowledged) {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  const auto path = folder / "run.gonio";
  Run::create(path, bench, {}, small_plan(bench, 40));
  {
    LostWritesVfs disk;
    Run run = Run::open(path, true, {.synced = synced, .vfs = LostWritesVfs::name()});
    for (std::size_t k = 0; k < acknowledged; ++k) run.append(reading_of(static_cast<std::int64_t>(k)));
    disk.lose_power();
  }
  return Run::open(path).readings().size();
}

}  // namespace

TEST_CASE("What a run is given comes back bit for bit") {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  SweepPlan plan = small_plan(bench, 5);
  plan.steps[3].partner = 4;
  plan.steps[4].state = StepState::masked;
  plan.steps[4].reason = "the head shadows the beam";
  plan.steps[4].axes.clear();
  const auto path = folder / "run.gonio";
  Reading refused = reading_of(2);
  refused.good = false;
  refused.reason = "saturated";
  {
    Run run = Run::create(path, bench, {}, plan);
    run.append(refused);
    run.append(reading_of(0));
    run.append(RunEvent{5, "start", "with \"quotes\" and ünïcode"});
    run.set_meta("context", "{}");
    run.set_meta("context", "{\"a\":1}");
  }
  const Run run = Run::open(path);
  const auto readings = run.readings();
  REQUIRE(readings.size() == 2);
  CHECK_FALSE(readings[0].good);
  CHECK(readings[0].reason == "saturated");
  const Reading asked = reading_of(0), &found = readings[1];
  CHECK(found.signal == asked.signal);
  CHECK(found.time == asked.time);
  CHECK(found.counts == asked.counts);
  CHECK(found.axes == asked.axes);
  const auto steps = run.steps();
  REQUIRE(steps.size() == plan.steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    CHECK(steps[k].axes == plan.steps[k].axes);
    CHECK(steps[k].kind == plan.steps[k].kind);
    CHECK(steps[k].state == plan.steps[k].state);
    CHECK(steps[k].reason == plan.steps[k].reason);
    CHECK(steps[k].partner == plan.steps[k].partner);
    CHECK(steps[k].pose.theta_o.degrees() == plan.steps[k].pose.theta_o.degrees());
  }
  CHECK(run.events().front().text == "with \"quotes\" and ünïcode");
  CHECK(run.meta().at("context") == "{\"a\":1}");
  CHECK(run.bench().document == bench.document);
  CHECK(run.accepted_steps() == std::set<std::int64_t>{0});
}

TEST_CASE("A reading is never stored twice") {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  Run run = Run::create(folder / "run.gonio", bench, {}, small_plan(bench, 3));
  run.append(reading_of(1));
  CHECK(kind_of([&] { run.append(reading_of(1)); }) == ErrorKind::internal);
  CHECK(kind_of([&] { run.append(reading_of(1000)); }) == ErrorKind::internal);  // no such step
  CHECK(run.readings().size() == 1);
}

TEST_CASE("An existing file is never overwritten") {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  const auto path = folder / "run.gonio";
  std::ofstream(path) << "precious";
  CHECK(kind_of([&] { Run::create(path, bench, {}, small_plan(bench, 1)); }) == ErrorKind::input);
  CHECK(gonio::test::read_file(path) == "precious");
  CHECK(kind_of([&] { Run::create(folder / "no-such-folder/run.gonio", bench, {}, small_plan(bench, 1)); }) == ErrorKind::input);
}

TEST_CASE("What is no run file is refused and left as it is") {
  TemporaryFolder folder;
  CHECK(kind_of([&] { Run::open(folder / "none.gonio"); }) == ErrorKind::input);
  for (const std::string& text : {std::string(), std::string("theta_i_deg,phi_i_deg\n1,2\n"), std::string(4096, '\0'),
                                  std::string("SQLite format 3\0", 16) + std::string(200, '\0')}) {
    const auto path = folder / "file";
    std::ofstream(path, std::ios::binary) << text;
    CHECK(kind_of([&] { Run::open(path, true); }) == ErrorKind::input);
    CHECK(gonio::test::read_file(path) == text);
  }
}

TEST_CASE("A second writer is refused") {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  const auto path = folder / "run.gonio";
  const Run run = Run::create(path, bench, {}, small_plan(bench, 3));
  CHECK(kind_of([&] { Run::open(path, true).append(reading_of(0)); }) == ErrorKind::input);
}

TEST_CASE("A damaged run file gives errors, never numbers from garbage or a crash") {
  TemporaryFolder folder;
  const Bench bench = ideal_bench();
  const auto path = folder / "run.gonio", damaged = folder / "damaged.gonio";
  {
    Run run = Run::create(path, bench, {}, small_plan(bench, 10));
    for (std::int64_t k = 0; k < 10; ++k) run.append(reading_of(k));
  }
  const std::string whole = gonio::test::read_file(path);
  constexpr unsigned seed = 5;
  std::mt19937 random(seed);
  int refused = 0;
  for (int k = 0; k < 400; ++k) {
    std::string bytes = whole;
    for (int n = 0; n < 1 + k % 8; ++n) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (k % 5 == 0) bytes.resize(random() % bytes.size());
    std::ofstream(damaged, std::ios::binary | std::ios::trunc) << bytes;
    CAPTURE(seed, k);
    try {
      const Run run = Run::open(damaged, k % 2 == 0);
      run.steps();
      run.readings();
      run.events();
      run.accepted_steps();
    } catch (const Error& e) {
      ++refused;
      if (e.kind() != ErrorKind::input) FAIL(e.what());
    }
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(damaged.string() + suffix);
  }
  CHECK(refused > 40);
}

TEST_CASE("Acknowledged readings survive a power failure, and the test would see it if they did not") {
  constexpr std::size_t acknowledged = 30;
  CHECK(kept_after_power_failure(true, acknowledged) == acknowledged);
  CHECK(kept_after_power_failure(false, acknowledged) < acknowledged);
}
