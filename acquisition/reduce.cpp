// SPDX-License-Identifier: BSD-3-Clause
// The relative measurement equation and its budget.
#include "acquisition/reduce.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "acquisition/kinematics.hpp"
#include "acquisition/meter_noise.hpp"
#include "acquisition/visits.hpp"
#include "brdf/error.hpp"

namespace gonio::acquisition {
namespace {

double seconds(BenchTime time) { return static_cast<double>(time) / static_cast<double>(second); }

/// K per unit of flux. An ideal receiver (half-angle 0) sees in proportion to cos theta_o; only ratios of K matter.
double receiver_factor(const Bench& bench, Angle theta_o) {
  const double half_angle = bench.apertures.receiver_half_angle_deg.value_or(0);
  return half_angle == 0 ? theta_o.cos() : projected_solid_angle(theta_o, degrees(half_angle));
}

/// Exposure and range: a dark signal belongs to one setting of the meter.
using Setting = std::pair<double, double>;
Setting setting_of(const Reading& reading) { return {reading.exposure_s, reading.range_w}; }

/// Good readings of one step, the last attempt of each repeat.
using StepReadings = std::vector<const Reading*>;

[[noreturn]] void refuse(std::string where, std::string found, std::string wanted) {
  throw Error(ErrorKind::input, "the run cannot be reduced", {{std::move(where), std::move(found), std::move(wanted)}});
}

class Reduction {
 public:
  Reduction(const Bench& bench, const std::vector<PlanStep>& steps, const std::vector<Reading>& readings)
      : bench_(bench), steps_(steps), kinematics_(make_kinematics(bench)) {
    collect(readings);
    noise_ = std::make_unique<NoiseModel>(bench.noise ? NoiseModel(*bench.noise, bench.range_w)
                                                      : NoiseModel(repeats_of(StepKind::dark), repeats_of(StepKind::reference)));
    find_darks();
    find_white();
  }

  Dataset samples() {
    Dataset data;
    describe(data);
    std::vector<double> dark_sensitivity;
    for (const PlanStep& step : steps_) {
      if (step.kind != StepKind::sample) continue;
      if (step.state == StepState::masked) {
        ++data.masked.blocked;
      } else if (const StepReadings& readings = readings_[step.number]; readings.empty()) {
        ++data.masked.missing;
      } else {
        add_sample(data, step, *readings.front(), dark_sensitivity);
      }
    }
    if (data.size() == 0) refuse("readings", "no good reading of the sample", "at least one");
    add_components(data, std::move(dark_sensitivity));
    data.require_consistent();
    return data;
  }

 private:
  void collect(const std::vector<Reading>& readings) {
    std::map<std::int64_t, std::map<int, const Reading*>> last;
    for (const Reading& reading : readings) {
      if (!reading.good) continue;
      const std::string where = fmt::format("reading of step {}, attempt {}", reading.step, reading.attempt);
      if (!std::isfinite(reading.signal)) refuse(where, fmt::format("signal {}", reading.signal), "a number");
      if (reading.axes.size() != bench_.axes.size())
        refuse(where, fmt::format("{} axis angles", reading.axes.size()), fmt::format("{}, one per axis of the bench", bench_.axes.size()));
      const Reading*& kept = last[reading.step][reading.repeat];
      if (!kept || reading.attempt > kept->attempt) kept = &reading;
    }
    for (const auto& [step, repeats] : last)
      for (const auto& [repeat, reading] : repeats) readings_[step].push_back(reading);
  }

  std::vector<RepeatedReadings> repeats_of(StepKind kind) {
    std::vector<RepeatedReadings> out;
    for (const PlanStep& step : steps_) {
      if (step.kind != kind) continue;
      RepeatedReadings visit;
      for (const Reading* reading : readings_[step.number])
        visit.signals.push_back(reading->signal), visit.exposure_s = reading->exposure_s;
      out.push_back(std::move(visit));
    }
    return out;
  }

  void find_darks() {
    std::map<Setting, std::vector<Visit>> visits;
    for (const PlanStep& step : steps_) {
      if (step.kind != StepKind::dark) continue;
      const StepReadings& readings = readings_[step.number];
      if (readings.empty()) continue;
      const auto n = static_cast<double>(readings.size());
      Visit visit;
      for (const Reading* r : readings) {
        visit.time_s += seconds(r->time) / n;
        visit.value += r->signal / n;
        visit.variance += noise_->variance(r->signal, r->exposure_s) / (n * n);
      }
      visits[setting_of(*readings.front())].push_back(visit);
    }
    for (auto& [setting, list] : visits) darks_.emplace(setting, Visits(std::move(list)));
  }

  const Visits& dark(const Reading& reading) const {
    const auto found = darks_.find(setting_of(reading));
    if (found == darks_.end())
      refuse(fmt::format("reading of step {}", reading.step), "no dark reading of its exposure and range",
             fmt::format("one of {:g} s in the range {:g} W", reading.exposure_s, reading.range_w));
    return found->second;
  }

  /// Visits of (S_r - D_r)/K(pose_r).
  void find_white() {
    std::vector<Visit> visits;
    for (const PlanStep& step : steps_) {
      if (step.kind != StepKind::reference) continue;
      const StepReadings& readings = readings_[step.number];
      if (readings.empty()) continue;
      const auto n = static_cast<double>(readings.size());
      Visit visit;
      for (const Reading* r : readings) {
        const double time = seconds(r->time), k = receiver_factor(bench_, kinematics_->pose(r->axes).theta_o);
        visit.time_s += time / n;
        visit.value += (r->signal - dark(*r).at(time)) / k / n;
        visit.variance += noise_->variance(r->signal, r->exposure_s) / (n * n * k * k);
        white_factor_ = k;
      }
      if (!(visit.value > 0))
        refuse(fmt::format("reference step {}", step.number), "a signal that is not above the dark", "light from the reference");
      visits.push_back(visit);
    }
    if (visits.empty()) refuse("readings", "no good reading of the reference", "at least one visit");
    visit_sensitivity_.resize(visits.size());
    white_.emplace(std::move(visits));
  }

  void add_sample(Dataset& data, const PlanStep& step, const Reading& r, std::vector<double>& dark_sensitivity) {
    const Pose pose = kinematics_->pose(r.axes);
    const double k = receiver_factor(bench_, pose.theta_o);
    if (!(k > 0) || !(pose.theta_i.cos() > 0)) {
      ++data.masked.below_horizon;
      return;
    }
    const double time = seconds(r.time), white = white_->at(time);
    const Visits& dark_level = dark(r);
    const double per_watt = bench_.reference.f_per_sr / (white * k);
    const double f = (r.signal - dark_level.at(time)) * bench_.reference.f_per_sr / white / k;
    const double var_read = per_watt * per_watt * (noise_->variance_without_shot(r.signal) + dark_level.local_variance(time));
    const double variance = var_read + per_watt * per_watt * noise_->shot_variance(r.signal, r.exposure_s);

    data.angles.push_back(pose);
    data.f[0].push_back(f);
    data.u[0].push_back(variance > 0 ? std::sqrt(variance) : std::numeric_limits<double>::quiet_NaN());
    // d ln f / d D: the dark is taken from the sample's signal and from the white's. At f = 0 the logarithm has no derivative.
    dark_sensitivity.push_back(f == 0 ? 0 : -per_watt / f + 1 / (white * white_factor_));
    // d ln f / d ln S_r of each visit: the two that this sample is interpolated between, by their shares.
    const Visits::Place place = white_->place(time);
    for (auto& sensitivity : visit_sensitivity_) sensitivity.push_back(0);
    visit_sensitivity_[place.before].back() -= (1 - place.share) * white_->all()[place.before].value / white;
    visit_sensitivity_[place.after].back() -= place.share * white_->all()[place.after].value / white;
    const auto column = [&](const char* name, double value) { data.extra[name].push_back(value); };
    column("var_read", var_read);
    column("time_s", time);
    column("step", static_cast<double>(step.number));
    column("range_w", r.range_w);
    column("exposure_s", r.exposure_s);
    column("rotation_deg", step.rotation_deg);
    column("commanded_theta_i_deg", step.pose.theta_i.degrees());
    column("commanded_phi_i_deg", step.pose.phi_i.degrees());
    column("commanded_theta_o_deg", step.pose.theta_o.degrees());
    column("commanded_phi_o_deg", step.pose.phi_o.degrees());
  }

  void add_components(Dataset& data, std::vector<double> dark_sensitivity) const {
    const auto add = [&](const std::string& name, double u, std::vector<double> sensitivity = {}) {
      if (u > 0) data.correlated.push_back({name, u, std::move(sensitivity)});
    };
    const Visits& white = *white_;
    double mean = 0;
    for (const Visit& visit : white.all()) mean += visit.value / static_cast<double>(white.all().size());
    add("certificate", bench_.reference.u_relative);
    for (std::size_t k = 0; k < white.all().size(); ++k)
      add(fmt::format("reference_noise_{}", k + 1), std::sqrt(white.all()[k].variance) / white.all()[k].value, visit_sensitivity_[k]);
    double dark_variance = 0;
    for (const auto& [setting, level] : darks_) dark_variance = std::max(dark_variance, level.common_variance());
    add("dark_noise", std::sqrt(dark_variance), std::move(dark_sensitivity));
    add("drift", white.straightness() / mean);
    for (const auto& [name, u] : bench_.correlated) add(name, u);
    data.provenance["noise"] = noise_->origin();
    if (white.all().size() < 2) data.provenance["drift"] = "unknown: one visit to the reference";
    const double dark_noise = std::sqrt(noise_->variance(darks_.begin()->second.all().front().value, bench_.exposure_s));
    const double normal = receiver_factor(bench_, degrees(0));
    if (std::isfinite(dark_noise))
      data.provenance["noise_equivalent_brdf_per_sr"] = fmt::format("{:.3g}", bench_.reference.f_per_sr * dark_noise / (mean * normal));
  }

  void describe(Dataset& data) const {
    Channel channel;
    channel.name = fmt::format("{:g}nm", bench_.wavelength_nm);
    channel.wavelength_in_nm = channel.wavelength_out_nm = bench_.wavelength_nm;
    channel.bandwidth_nm = bench_.bandwidth_nm;
    channel.polarisation_in = bench_.polarisation_source;
    channel.polarisation_out = bench_.polarisation_receiver;
    data.channels = {channel};
    data.f.resize(1);
    data.u.resize(1);
    data.apertures = bench_.apertures;
    data.simulated = bench_.is_simulated;
    data.provenance["instrument"] = bench_.name;
    data.provenance["reference"] = bench_.reference.name;
    data.provenance["bench_sha256"] = bench_.sha256;
    if (!bench_.polarisation_source || !bench_.polarisation_receiver)
      data.provenance["polarisation"] = "unknown: near Brewster's angle the gloss part may read up to twice too much or nothing at all";
  }

  const Bench& bench_;
  const std::vector<PlanStep>& steps_;
  std::unique_ptr<Kinematics> kinematics_;
  std::unique_ptr<NoiseModel> noise_;
  std::map<std::int64_t, StepReadings> readings_;
  std::map<Setting, Visits> darks_;
  std::optional<Visits> white_;                         // found in the constructor
  double white_factor_ = 1;                             // K of the reference's pose
  std::vector<std::vector<double>> visit_sensitivity_;  // [visit][sample]
};

}  // namespace

Dataset reduce(const Bench& bench, const std::vector<PlanStep>& steps, const std::vector<Reading>& readings) {
  return Reduction(bench, steps, readings).samples();
}

Dataset reduce(const Run& run) {
  Dataset data = reduce(run.bench(), run.steps(), run.readings());
  data.provenance["plan_sha256"] = run.request().sha256;
  return data;
}

}  // namespace gonio::acquisition
