// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/radial_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabulated/node_values.hpp"
#include "tabulated/specular_angles.hpp"

namespace gonio::tabulated {
namespace {

constexpr double first_step_deg = 10, least_interval_deg = 0.01, good_enough = 1e-3, least_part_of_peak = 1e-4;

/// f, all channels added, on all rays from the specular direction at one radial angle; NaN beyond the horizon and where unknown.
class Rays {
 public:
  Rays(const Opened& source, std::span<const double> incidence_deg, Side side, int threads)
      : source_(source), side_(side), threads_(threads) {
    const int turns = source.brdf && source.brdf->symmetry().isotropic ? 1 : 4;
    constexpr int azimuths = 8;
    for (const double incidence : incidence_deg)
      for (int p = 0; p < turns; ++p)
        for (int a = 0; a < azimuths; ++a) rays_.push_back({degrees(incidence), degrees(p * 45.0), a * 360.0 / azimuths});
  }
  std::size_t size() const noexcept { return rays_.size(); }

  std::vector<double> values(double radial_deg) const {
    std::vector<Direction> wi, wo;
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < rays_.size(); ++k) {
      const GonioAngles pose = from_specular(rays_[k].theta_i, rays_[k].phi_i, {radial_deg, rays_[k].azimuth_deg}, side_);
      if (side_ == Side::reflection ? !(pose.theta_o.degrees() < 90) : !(pose.theta_o.degrees() > 90)) continue;
      wi.push_back(pose.wi()), wo.push_back(pose.wo()), at.push_back(k);
    }
    ExportNotes not_the_file;
    const NodeValues nodes = node_values(source_, wi, wo, threads_, not_the_file);
    std::vector<double> out(rays_.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t n = 0; n < at.size(); ++n) {
      out[at[n]] = 0;
      for (std::size_t c = 0; c < nodes.channel_count; ++c) out[at[n]] += nodes.f[n * nodes.channel_count + c];
    }
    return out;
  }

 private:
  struct Ray {
    Angle theta_i, phi_i;
    double azimuth_deg;
  };
  const Opened& source_;
  Side side_;
  int threads_;
  std::vector<Ray> rays_;
};

struct Interval {
  double low = 0, high = 0, error = 0;
  std::vector<double> at_low, at_middle, at_high;
};

}  // namespace

std::vector<double> radial_grid(const Opened& source, std::span<const double> incidence_deg, Side side, std::size_t count, int threads) {
  const Rays rays(source, incidence_deg, side, threads);
  std::vector<double> angles = even_angles(0, 180, first_step_deg);
  std::vector<std::vector<double>> known;
  for (const double angle : angles) known.push_back(rays.values(angle));
  double peak = 0;
  for (const auto& values : known)
    for (const double value : values) peak = std::isnan(value) ? peak : std::max(peak, std::fabs(value));

  const auto measure = [&](Interval interval) {
    interval.at_middle = rays.values((interval.low + interval.high) / 2);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const double line = (interval.at_low[k] + interval.at_high[k]) / 2, value = interval.at_middle[k];
      if (std::isnan(line) || std::isnan(value)) continue;
      const double scale = std::max(std::fabs(value), least_part_of_peak * peak);
      if (scale > 0) interval.error = std::max(interval.error, std::fabs(value - line) / scale);
    }
    return interval;
  };
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k + 1 < angles.size(); ++k)
    intervals.push_back(measure({angles[k], angles[k + 1], 0, known[k], {}, known[k + 1]}));
  while (angles.size() < count) {
    const auto worst = std::max_element(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
      const auto weight = [](const Interval& interval) { return interval.high - interval.low > least_interval_deg ? interval.error : 0; };
      return weight(a) < weight(b);
    });
    if (!(worst->error > good_enough && worst->high - worst->low > least_interval_deg)) break;
    const Interval split = *worst;
    const double middle = (split.low + split.high) / 2;
    angles.push_back(middle);
    *worst = measure({split.low, middle, 0, split.at_low, {}, split.at_middle});
    intervals.push_back(measure({middle, split.high, 0, split.at_middle, {}, split.at_high}));
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

std::vector<double> incidence_grid(GridSize size) {
  std::vector<double> out = size == GridSize::paper      ? even_angles(0, 70, 10)
                            : size == GridSize::standard ? even_angles(0, 80, 5)
                                                         : even_angles(0, 86, 2);
  out.push_back(size == GridSize::fine ? 88 : 89);
  return out;
}

std::vector<double> even_angles(double first, double last, double step) {
  std::vector<double> out;
  const auto count = static_cast<std::size_t>(std::floor((last - first) / step + 0.5));
  for (std::size_t k = 0; k <= count; ++k) out.push_back(first + static_cast<double>(k) * step);
  return out;
}

}  // namespace gonio::tabulated
