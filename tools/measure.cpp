// SPDX-License-Identifier: BSD-3-Clause
#include "tools/measure.hpp"

#include <atomic>
#include <chrono>
#include <optional>

#include <fmt/format.h>

#include "acquisition/connect.hpp"
#include "acquisition/simulated/simulated_bench.hpp"
#include "tools/bench_source.hpp"
#include "tools/stop_signal.hpp"

namespace gonio::tools {

using namespace gonio::acquisition;

bool is_embedded(const Bench& bench) { return bench.is_simulated && bench.modbus.port == 0; }

SweepResult measure(Run& run, const Bench& bench, std::shared_ptr<const Brdf> sample, ClockChoice choice, const Console& console) {
  const std::atomic<bool>& stop = stop_on_signals();
  Bench reachable = bench;
  std::shared_ptr<Clock> clock;
  if (choice == ClockChoice::real) clock = std::make_shared<RealClock>();
  std::optional<simulated::SimulatedBench> embedded;
  if (is_embedded(bench)) {
    if (!clock) clock = std::make_shared<VirtualClock>();
    embedded.emplace(bench, std::move(sample), clock);
    reachable.modbus.port = embedded->ports().modbus;
    reachable.scpi.port = embedded->ports().scpi;
  } else if (choice == ClockChoice::virtual_time) {
    throw Error(ErrorKind::usage, {"--clock", "virtual for a bench on the network", "gonio serve --clock virtual, which owns it"});
  }
  ConnectedBench devices = connect(reachable, clock, &stop);

  SweepPlan plan;
  plan.steps = run.steps();
  SweepOptions options;
  options.stop = &stop;
  using Wall = std::chrono::steady_clock;
  auto shown = Wall::now();
  options.progress = [&](const SweepProgress& p) {
    const auto now = Wall::now();
    if (now - shown < console.progress_interval()) return;
    shown = now;
    console.progress(fmt::format("sweep: {} of {} steps, bench time {}, {} to go", p.done, p.total, duration_text(p.bench_s),
                                 duration_text(p.eta_wall_s)));
  };
  const SweepResult result = sweep(run, plan, *devices.gantry, *devices.detector, *devices.source, *devices.clock, options);
  console.progress("");
  return result;
}

}  // namespace gonio::tools
