// SPDX-License-Identifier: BSD-3-Clause
// The synthetic material of the figures as a table with MERL's rows of theta_h, with fewer cells in each.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "brdf/observations.hpp"

namespace gonio::test {

/// 90 rows at θh = (i + 1/2)²/90 degrees, [channel][cell] each; a negative value in any channel masks the cell. Only models that depend on
/// θh alone can be fitted: the cells of a row have no other geometry.
class ThetaHTable final : public Observations {
 public:
  static constexpr std::size_t row_count = 90;
  std::vector<std::vector<std::vector<double>>> value;  ///< [row][channel][cell] 1/sr

  explicit ThetaHTable(const Channels& channels) : value(row_count), channels_(channels) {
    for (std::size_t row = 0; row < row_count; ++row) {
      value[row].resize(channels_.size());
      geometry_.push_back(lobe_geometry(angles_of(row)));
    }
  }
  static GonioAngles angles_of(std::size_t row) {
    const double theta_h_deg = std::pow(static_cast<double>(row) + .5, 2) / static_cast<double>(row_count);
    return {degrees(theta_h_deg), degrees(0), degrees(theta_h_deg), degrees(0)};
  }

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {.isotropic = true, .bilateral = false, .reciprocal = true}; }
  std::size_t block_count() const override { return row_count; }
  ObservationBlock block(std::size_t row) const override {
    ObservationBlock out;
    out.size = value[row].front().size();
    out.constant = ConstantOver::theta_h;
    out.log_cos_h = geometry_[row].log_cos_h;
    for (const std::vector<double>& channel : value[row]) out.f.push_back({channel.data()});
    out.validity = ObservationBlock::Validity::no_channel_negative;
    return out;
  }
  void geometry(std::size_t row, std::vector<LobeGeometry>& out) const override { out.assign(value[row].front().size(), geometry_[row]); }
  void angles(std::size_t row, std::vector<GonioAngles>& out) const override { out.assign(value[row].front().size(), angles_of(row)); }

 private:
  Channels channels_;
  std::vector<LobeGeometry> geometry_;
};

/// f (1 + 1 % N) + 1e-4 N' in `cells` cells a row, of which the part 1 - cos θh at its end lies below the horizon and is -1.
inline ThetaHTable noisy_table(const AnalyticBrdf& truth, std::size_t cells, unsigned seed) {
  ThetaHTable out(truth.channels());
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (std::size_t row = 0; row < ThetaHTable::row_count; ++row) {
    const GonioAngles angles = ThetaHTable::angles_of(row);
    const std::vector<double> f = truth.eval(angles);
    const auto above = static_cast<std::size_t>(std::ceil(angles.theta_i.cos() * static_cast<double>(cells)));
    for (std::size_t c = 0; c < f.size(); ++c)
      for (std::size_t k = 0; k < cells; ++k) {
        const double gain = normal(random), read = normal(random);
        out.value[row][c].push_back(k < above ? f[c] * (1 + .01 * gain) + 1e-4 * read : -1);
      }
  }
  return out;
}

}  // namespace gonio::test
