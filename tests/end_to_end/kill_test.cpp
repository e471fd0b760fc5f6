// SPDX-License-Identifier: BSD-3-Clause
// SIGKILL at 100 random instants of a sweep, the bench in a process of its own: nothing is lost, nothing is measured twice.
#include <map>
#include <random>
#include <tuple>

#include "acquisition/run.hpp"
#include "data-schemas/document.hpp"
#include "tests/command.hpp"
#include "tests/process.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr unsigned seed = 20260702;
constexpr int kills_wanted = 100;

/// The demo's bench without drift: a reading then does not depend on when it is taken.
std::string bench_without_drift() {
  Json bench = parse_json(example_text("demo.bench.json"), "bench");
  Json simulated = bench.at("simulated"), effects = Json::object();
  for (const auto& [effect, setting] : simulated.at("effects").members())
    if (effect != "drift_per_hour") effects.set(effect, setting);
  simulated.set("effects", effects);
  bench.set("simulated", simulated);
  return bench.dump();
}

/// Every accepted reading by (step, repeat): what the meter printed and where the drives were.
using Values = std::map<std::pair<std::int64_t, int>, std::pair<double, std::vector<std::int64_t>>>;

Values accepted(const std::filesystem::path& path) {
  const acquisition::Run run = acquisition::Run::open(path);
  Values values;
  for (const acquisition::Reading& reading : run.readings()) {
    if (!reading.good) continue;
    const bool first = values.emplace(std::pair(reading.step, reading.repeat), std::pair(reading.signal, reading.counts)).second;
    INFO("step " << reading.step << " repeat " << reading.repeat);
    CHECK(first);  // exactly once
  }
  return values;
}

}  // namespace

TEST_CASE("a sweep killed at 100 random instants and resumed reads bit for bit what an uninterrupted one does") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "bench.json", bench_without_drift());
  test::write_file(folder / "plan.json", std::string(example_text("demo.plan.json")));
  const std::string binary = GONIO_BINARY, bench = (folder / "bench.json").string(), plan = (folder / "plan.json").string();

  test::Process server({binary, "serve", bench, "--clock", "virtual"});
  const Json ready = parse_json(server.line(), "ready line");
  REQUIRE(ready.at("ready").boolean());
  const auto command = [&](const std::string& out, bool resume) {
    std::vector<std::string> arguments{binary,
                                       "sweep",
                                       plan,
                                       "--bench",
                                       bench,
                                       "--out",
                                       (folder / out).string(),
                                       "--quiet",
                                       "--modbus",
                                       "127.0.0.1:" + std::to_string(ready.at("modbus").integer()),
                                       "--scpi",
                                       "127.0.0.1:" + std::to_string(ready.at("scpi").integer())};
    if (resume) arguments.emplace_back("--resume");
    return arguments;
  };

  {
    test::Process whole(command("whole.gonio", false));
    REQUIRE(whole.wait() == 0);
  }
  const Values expected = accepted(folder / "whole.gonio");
  REQUIRE(expected.size() > 500);

  std::mt19937 random(seed);
  INFO("seed " << seed);
  int kills = 0, sweeps = 0;
  while (kills < kills_wanted) {
    const std::string out = "killed" + std::to_string(sweeps++) + ".gonio";
    bool started = false;
    while (true) {
      test::Process sweep(command(out, started));
      // Most instants fall into the sweep itself, some into start-up and the end. Only the choice of instant depends on real time.
      const int instant_ms = std::uniform_int_distribution<int>(0, 250)(random);
      if (kills < kills_wanted && !sweep.ends_within(instant_ms)) {
        sweep.signal(SIGKILL);
        sweep.wait();
        ++kills;
      } else {
        const int code = sweep.wait();
        INFO("exit code " << code << " after " << kills << " kills");
        REQUIRE(code == 0);
        break;
      }
      // Killed before the run file was whole: the next attempt starts anew, as a person would.
      started = std::filesystem::exists(folder / out);
    }
    CHECK(accepted(folder / out) == expected);
  }
  WARN(kills << " kills over " << sweeps << " sweeps of " << expected.size() << " readings");
  server.signal(SIGTERM);
  CHECK(server.wait() == 0);
}
