// SPDX-License-Identifier: BSD-3-Clause
// From a plan's request to its steps.
#include "acquisition/plan.hpp"

#include <algorithm>

#include "acquisition/ordering.hpp"
#include "acquisition/plan_points.hpp"
#include "acquisition/trapezoidal_motion.hpp"

namespace gonio::acquisition {
namespace {

/// Writes the steps down one by one and keeps the predicted time.
class Script {
 public:
  Script(const PlanRequest& request, const Bench& bench, const Kinematics& kinematics)
      : bench_(bench), kinematics_(kinematics), moves_(!bench.is_simulated || bench.simulated.motion), position_(bench.axes.size(), 0.0) {
    exposures_.push_back(bench.exposure_s);
    sample_exposure_ = request.exposure_s.value_or(bench.exposure_s);
    if (sample_exposure_ != bench.exposure_s) exposures_.push_back(sample_exposure_);
    for (const Axis& axis : bench.axes) settle_s_ = std::max(settle_s_, axis.settle_s);
  }

  /// Dark and reference, at the pose of the reference.
  void visit_reference() {
    const AxisAngles axes = kinematics_.solutions(bench_.reference.pose, &position_).front();
    go_to(axes);
    add_dark(bench_.reference.pose);
    PlanStep step;
    step.kind = StepKind::reference;
    step.pose = bench_.reference.pose;
    step.exposure_s = bench_.exposure_s;
    add(step);
    last_reference_s_ = seconds_;
  }

  /// Whatever is due by now, then the point.
  void measure(const PlanPoint& point, const AxisAngles& axes) {
    if (seconds_ - last_reference_s_ >= bench_.reference.interval_s) visit_reference();
    if (seconds_ - last_dark_s_ >= bench_.dark_interval_s) add_dark(last_pose_);
    go_to(axes);
    PlanStep step = sample_step(point);
    step.axes = axes;
    add(step);
  }

  void record(const PlanPoint& point) {
    PlanStep step = sample_step(point);
    step.state = point.state;
    step.reason = point.reason;
    append(step);
  }

  std::vector<PlanStep> steps;
  double seconds() const { return seconds_; }
  const AxisAngles& position() const { return position_; }

 private:
  PlanStep sample_step(const PlanPoint& point) const {
    PlanStep step;
    step.pose = point.pose;
    step.exposure_s = sample_exposure_;
    step.rotation_deg = point.rotation_deg;
    return step;
  }

  void add_dark(const Pose& pose) {
    for (const double exposure : exposures_) {
      PlanStep step;
      step.kind = StepKind::dark;
      step.pose = pose;
      step.exposure_s = exposure;
      add(step);
    }
    last_dark_s_ = seconds_;
  }

  void go_to(const AxisAngles& axes) {
    if (moves_) seconds_ += move_time_s(position_, axes, bench_);
    seconds_ += settle_s_;
    position_ = axes;
  }

  void add(PlanStep step) {
    step.axes = position_;
    seconds_ += step.exposure_s * readings_at(step.kind, bench_);
    last_pose_ = step.pose;
    append(std::move(step));
  }

  void append(PlanStep step) {
    step.number = static_cast<std::int64_t>(steps.size());
    steps.push_back(std::move(step));
  }

  const Bench& bench_;
  const Kinematics& kinematics_;
  bool moves_;
  std::vector<double> exposures_;
  double sample_exposure_ = 0, settle_s_ = 0;
  AxisAngles position_;  // every axis wakes up at 0°
  Pose last_pose_;
  double seconds_ = 0, last_dark_s_ = 0, last_reference_s_ = 0;
};

}  // namespace

const char* name(StepKind kind) noexcept {
  switch (kind) {
    case StepKind::sample: return "sample";
    case StepKind::dark: return "dark";
    case StepKind::reference: return "reference";
  }
  return "";
}

const char* name(StepState state) noexcept {
  switch (state) {
    case StepState::ok: return "ok";
    case StepState::masked: return "masked";
    case StepState::unreachable: return "unreachable";
  }
  return "";
}

int readings_at(StepKind kind, const Bench& bench) noexcept {
  switch (kind) {
    case StepKind::dark: return bench.dark_readings;
    case StepKind::reference: return bench.reference.readings;
    case StepKind::sample: break;
  }
  return 1;
}

std::size_t SweepPlan::count(StepKind kind, StepState state) const {
  return static_cast<std::size_t>(
      std::count_if(steps.begin(), steps.end(), [&](const PlanStep& step) { return step.kind == kind && step.state == state; }));
}

double move_time_s(const AxisAngles& from, const AxisAngles& to, const Bench& bench) {
  double longest = 0;
  for (std::size_t a = 0; a < bench.axes.size(); ++a)
    longest = std::max(longest, move_duration_s(to[a] - from[a], bench.axes[a].speed_deg_per_s, bench.axes[a].acceleration_deg_per_s2));
  return longest;
}

SweepPlan make_plan(const PlanRequest& request, const Bench& bench) {
  const auto kinematics = make_kinematics(bench);
  std::vector<PlanPoint> points = plan_points(request, *kinematics);
  std::vector<std::size_t> measured;
  std::vector<std::vector<AxisAngles>> solutions;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].state != StepState::ok) continue;
    measured.push_back(k);
    solutions.push_back(std::move(points[k].solutions));
  }
  Script script(request, bench, *kinematics);
  script.visit_reference();
  const PointOrder order = order_points(solutions, kinematics->incident_axes(), bench, script.position());
  std::vector<std::size_t> step_of(points.size());
  for (std::size_t k = 0; k < order.points.size(); ++k) {
    const std::size_t p = measured[order.points[k]];
    script.measure(points[p], order.axes[k]);
    step_of[p] = script.steps.size() - 1;
  }
  script.visit_reference();
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p].state == StepState::ok) continue;
    script.record(points[p]);
    step_of[p] = script.steps.size() - 1;
  }
  for (std::size_t p = 0; p < points.size(); ++p)
    if (points[p].partner) script.steps[step_of[p]].partner = static_cast<std::int64_t>(step_of[*points[p].partner]);

  SweepPlan plan;
  plan.steps = std::move(script.steps);
  plan.predicted_s = script.seconds();
  plan.travel_deg = order.travel_deg;
  plan.travel_bound_deg = order.travel_bound_deg;
  plan.motion_s = order.motion_s;
  plan.motion_bound_s = order.motion_bound_s;
  return plan;
}

}  // namespace gonio::acquisition
