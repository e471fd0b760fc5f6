// SPDX-License-Identifier: BSD-3-Clause
// A whole sweep on the embedded simulated bench, in this process.
#pragma once

#include <filesystem>
#include <memory>

#include "acquisition/connect.hpp"
#include "acquisition/reduce.hpp"
#include "acquisition/simulated/simulated_bench.hpp"
#include "acquisition/sweep.hpp"
#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"

namespace gonio::test {

/// The bench of an example file, with another seed.
inline acquisition::Bench example_bench(const std::string& name, std::uint64_t seed) {
  Json document = parse_json(example_text(name), name);
  Json simulated = document.at("simulated");
  simulated.set("seed", seed);
  document.set("simulated", simulated);
  return acquisition::bench_from(document, ".", name);
}

inline acquisition::PlanRequest example_plan(const std::string& name) {
  return acquisition::plan_from(parse_json(example_text(name), name), name);
}

/// The model that lies on the bench of an example file.
inline std::shared_ptr<const AnalyticBrdf> example_sample(const acquisition::Bench& bench) {
  const auto& sample = bench.simulated.sample.value();
  std::vector<double> values;
  for (const Parameter& p : model_info(sample.model).parameters) values.push_back(sample.parameters.at(std::string(p.name)));
  return std::make_shared<AnalyticBrdf>(sample.model, single_channel("value"), std::vector<std::vector<double>>{values});
}

/// Plan, sweep over real sockets on the virtual clock into `path`, and reduce.
inline Dataset measure(const acquisition::Bench& bench, const acquisition::PlanRequest& request, std::shared_ptr<const Brdf> sample,
                       const std::filesystem::path& path) {
  using namespace acquisition;
  const SweepPlan plan = make_plan(request, bench);
  const auto clock = std::make_shared<VirtualClock>();
  simulated::SimulatedBench devices(bench, std::move(sample), clock);
  Bench reachable = bench;
  reachable.modbus.port = devices.ports().modbus;
  reachable.scpi.port = devices.ports().scpi;
  Run run = Run::create(path, bench, request, plan);
  ConnectedBench connected = connect(reachable, clock);
  sweep(run, plan, *connected.gantry, *connected.detector, *connected.source, *connected.clock, {});
  return reduce(run);
}

}  // namespace gonio::test
