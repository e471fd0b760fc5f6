// SPDX-License-Identifier: BSD-3-Clause
// An ideal simulated bench in memory, a small plan for it, and a folder of its own: what the tests of the devices share.
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "acquisition/connect.hpp"
#include "acquisition/kinematics.hpp"
#include "acquisition/run.hpp"
#include "acquisition/simulated/simulated_bench.hpp"
#include "acquisition/sweep.hpp"
#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tests/temporary_folder.hpp"

namespace gonio::acquisition::test {

/// The example bench without any error; ports 0. Effects are switched on by setting members.
inline Bench ideal_bench() { return load_bench(std::filesystem::path(GONIO_SOURCE_DIR) / "data-schemas/examples/valid/ideal.bench.json"); }

inline std::shared_ptr<const AnalyticBrdf> sample() {
  return std::make_shared<AnalyticBrdf>("blinn-phong", single_channel("550nm"), std::vector<std::vector<double>>{{0.25, 0.35, 60}});
}

using gonio::test::TemporaryFolder;

/// Dark and reference, then `points` sample poses in and out of the plane of incidence with a dark and a reference every 20, and again at
/// the end.
inline SweepPlan small_plan(const Bench& bench, int points, double exposure_s = 0.1) {
  const auto kinematics = make_kinematics(bench);
  SweepPlan plan;
  AxisAngles last;
  const auto add = [&](StepKind kind, const Pose& pose) {
    PlanStep step;
    step.number = static_cast<std::int64_t>(plan.steps.size());
    step.kind = kind;
    step.pose = pose;
    const auto solutions = kinematics->solutions(pose, last.empty() ? nullptr : &last);
    if (solutions.empty()) {
      step.state = StepState::unreachable;
      step.reason = kinematics->unreachable_reason(pose);
    } else {
      step.axes = last = solutions.front();
    }
    step.exposure_s = exposure_s;
    plan.steps.push_back(step);
    plan.predicted_s += 1;
  };
  const auto calibrate = [&] {
    add(StepKind::dark, bench.reference.pose);
    add(StepKind::reference, bench.reference.pose);
  };
  for (int k = 0; k < points; ++k) {
    if (k % 20 == 0) calibrate();
    add(StepKind::sample, {degrees(5 + k * 37 % 60), degrees(0), degrees(8 + k * 53 % 70), degrees(180 - k * 29 % 90)});
  }
  calibrate();
  return plan;
}

/// A simulated bench on loopback with its devices connected to it.
struct EmbeddedBench {
  explicit EmbeddedBench(Bench b, std::shared_ptr<const Brdf> brdf = sample(), std::shared_ptr<Clock> c = std::make_shared<VirtualClock>())
      : bench(std::move(b)), clock(std::move(c)), simulated(bench, std::move(brdf), clock) {
    bench.modbus.port = simulated.ports().modbus;
    bench.scpi.port = simulated.ports().scpi;
  }

  Bench bench;
  std::shared_ptr<Clock> clock;
  simulated::SimulatedBench simulated;
};

inline SweepResult sweep_embedded(Run& run, const Bench& bench, const SweepPlan& plan, const SweepOptions& options = {}) {
  EmbeddedBench embedded(bench);
  ConnectedBench devices = connect(embedded.bench, embedded.clock);
  return sweep(run, plan, *devices.gantry, *devices.detector, *devices.source, *devices.clock, options);
}

}  // namespace gonio::acquisition::test
