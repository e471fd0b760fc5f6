// SPDX-License-Identifier: BSD-3-Clause
// The physics of a reading: source, surface, receiver, dark and noise.
#include "acquisition/simulated/optics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "acquisition/reduce.hpp"
#include "acquisition/simulated/noise.hpp"
#include "brdf/analytic_brdf.hpp"

namespace gonio::acquisition::simulated {
namespace {

/// The last word of a key: which of the independent deviates.
enum Draw : std::uint64_t { certificate, shot, read };

constexpr BenchTime hour = 3600 * second;

/// Orders of the cubature over each aperture: 16 and 36 directions, exact for a lobe that is a polynomial of degree 7 and 11 across it.
constexpr int source_order = 2, receiver_order = 3;

/// K of the measurement equation per unit of flux. An ideal receiver (half-angle 0) counts as one steradian: only ratios matter then.
double receiver_factor(Angle theta_o, Angle half_angle) {
  if (half_angle.degrees() == 0) return std::max(0.0, theta_o.cos());
  return projected_solid_angle(theta_o, half_angle);
}

}  // namespace

Optics::Optics(const Bench& bench, std::shared_ptr<const Brdf> sample)
    : effects_(bench.simulated),
      seed_(bench.seed),
      source_power_w_(bench.source_power_w),
      white_f_(bench.reference.f_per_sr),
      receiver_half_angle_(degrees(bench.apertures.receiver_half_angle_deg.value_or(0))),
      sample_(std::move(sample)) {
  const auto radians_of = [](std::optional<double> half_angle_deg) { return degrees(half_angle_deg.value_or(0)).radians(); };
  apertures_.source = radians_of(bench.apertures.source_half_angle_deg);
  apertures_.receiver = radians_of(bench.apertures.receiver_half_angle_deg);
  apertures_.source_order = apertures_.source > 0 ? source_order : 0;
  apertures_.receiver_order = apertures_.receiver > 0 ? receiver_order : 0;
  if (effects_.certificate_error) white_f_ *= 1 + bench.reference.u_relative * normal_deviate({seed_, Draw::certificate});
}

double Optics::sample_f(const Pose& pose) const {
  if (!apertures_.point()) {
    double mean = 0;
    for (const AperturePair& pair : aperture_pairs(pose, apertures_)) mean += pair.weight * sample_->eval(pair.wi, pair.wo).front();
    return mean;
  }
  if (const auto* model = dynamic_cast<const AnalyticBrdf*>(sample_.get())) return model->eval(pose).front();
  return sample_->eval(pose.wi(), pose.wo()).front();
}

double Optics::signal_w(const Exposure& e) const {
  double signal = effects_.dark.value_or(0);
  if (e.shutter_open) {
    const bool is_lit = e.pose.theta_i.cos() > 0;
    const double f = !is_lit ? 0 : e.white_in_beam ? white_f_ : sample_f(e.pose);
    const double drift = effects_.drift_per_hour.value_or(0) * static_cast<double>(e.middle) / static_cast<double>(hour);
    signal += source_power_w_ * (1 + drift) * f * receiver_factor(e.pose.theta_o, receiver_half_angle_);
  }
  const auto deviate = [&](Draw draw) {
    return normal_deviate({seed_, draw, static_cast<std::uint64_t>(e.tag.step), static_cast<std::uint64_t>(e.tag.kind),
                           static_cast<std::uint64_t>(e.tag.attempt), static_cast<std::uint64_t>(e.tag.repeat)});
  };
  double noise = 0;
  if (effects_.shot_counts_per_unit) {
    noise += std::sqrt(std::max(0.0, signal) / (*effects_.shot_counts_per_unit * e.exposure_s)) * deviate(Draw::shot);
  }
  if (effects_.read_noise) noise += *effects_.read_noise * deviate(Draw::read);
  return signal + noise;
}

}  // namespace gonio::acquisition::simulated
