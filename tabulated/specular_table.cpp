// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/specular_table.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "brdf/error.hpp"
#include "tabulated/formats/angle_list.hpp"

namespace gonio::tabulated {

GonioAngles SpecularGrid::angles(std::size_t rotation, std::size_t incidence, std::size_t azimuth, std::size_t radial) const {
  double phi_i = 0;
  if (rotation_deg.size() > 1) {
    const double turn = sense == RotationSense::counter_clockwise ? rotation_deg[rotation] : -rotation_deg[rotation];
    phi_i = std::fmod(phi_i_at_rotation_0_deg + turn, 360.0);
    if (phi_i < 0) phi_i += 360;
  }
  return from_specular(degrees(incidence_deg[incidence]), degrees(phi_i), {radial_deg[radial], azimuth_deg[azimuth]}, side);
}

bool SpecularGrid::beyond_horizon(const GonioAngles& node) const noexcept {
  return side == Side::reflection ? node.theta_o.degrees() > 90 : node.theta_o.degrees() < 90;
}

SpecularTable::SpecularTable(SpecularGrid grid, Channels channels, std::vector<std::vector<double>> values)
    : grid_(std::move(grid)), channels_(std::move(channels)), values_(std::move(values)) {
  bool fits = values_.size() == channels_.size();
  for (const auto& column : values_) fits = fits && column.size() == grid_.size();
  if (!fits)
    throw Error(ErrorKind::internal, {"a table about the specular direction", "values that are not those of its grid", "one per node"});
  for (std::size_t i = 0; i < grid_.incidence_deg.size(); ++i)
    for (std::size_t a = 0; a < grid_.azimuth_deg.size(); ++a)
      for (std::size_t r = 0; r < grid_.radial_deg.size(); ++r) beyond_.push_back(grid_.beyond_horizon(grid_.angles(0, i, a, r)));
}

Symmetry SpecularTable::symmetry() const {
  const bool isotropic = grid_.rotation_deg.size() == 1;
  return {isotropic, isotropic && grid_.mirrored, false};
}

void SpecularTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  const std::size_t channel_count = channels_.size();
  const bool reflection = grid_.side == Side::reflection;
  for (std::size_t k = 0; k < wi.size(); ++k) {
    const std::span<double> out = f.subspan(k * channel_count, channel_count);
    std::fill(out.begin(), out.end(), 0.0);
    if (!(wi[k].z() > 0) || (reflection ? !(wo[k].z() > 0) : !(wo[k].z() < 0))) continue;

    SpecularAngles at = to_specular(wi[k], wo[k], grid_.side);
    if (grid_.mirrored && at.azimuth_deg > 180) at.azimuth_deg = 360 - at.azimuth_deg;
    const double turn = wi[k].phi().degrees() - phi_i_at_rotation_0_deg;
    const std::array<Bracket, 4> brackets{
        bracket_azimuth(grid_.rotation_deg, grid_.sense == RotationSense::counter_clockwise ? turn : -turn),
        bracket(grid_.incidence_deg, wi[k].theta().degrees()),
        grid_.mirrored ? bracket(grid_.azimuth_deg, at.azimuth_deg) : bracket_azimuth(grid_.azimuth_deg, at.azimuth_deg),
        bracket(grid_.radial_deg, at.radial_deg)};
    double weights = 0;
    for (unsigned corner = 0; corner < 16; ++corner) {
      double weight = 1;
      std::array<std::size_t, 4> node{};
      for (unsigned axis = 0; axis < 4; ++axis) {
        const Bracket& between = brackets[axis];
        const bool upper = (corner >> axis & 1) != 0;
        node[axis] = upper ? between.high : between.low;
        weight *= !between.known ? 0 : upper ? between.weight : 1 - between.weight;
      }
      if (!(weight > 0)) continue;
      if (beyond_[(node[1] * grid_.azimuth_deg.size() + node[2]) * grid_.radial_deg.size() + node[3]]) continue;
      weights += weight;
      const std::size_t index = grid_.index(node[0], node[1], node[2], node[3]);
      for (std::size_t c = 0; c < channel_count; ++c) out[c] += weight * values_[c][index];
    }
    for (double& value : out) value = weights > 0 ? value / weights : std::numeric_limits<double>::quiet_NaN();
  }
}

Dataset SpecularTable::samples() const {
  Dataset out;
  out.channels = channels_;
  out.symmetry = symmetry();
  out.side = grid_.side;
  out.f.resize(channels_.size());
  for (std::size_t p = 0; p < grid_.rotation_deg.size(); ++p)
    for (std::size_t i = 0; i < grid_.incidence_deg.size(); ++i)
      for (std::size_t a = 0; a < grid_.azimuth_deg.size(); ++a)
        for (std::size_t r = 0; r < grid_.radial_deg.size(); ++r) {
          const GonioAngles node = grid_.angles(p, i, a, r);
          if (grid_.beyond_horizon(node)) {
            ++out.masked.below_horizon;
            continue;
          }
          const std::size_t index = grid_.index(p, i, a, r), first = grid_.index(p, i, 0, r);
          bool seen = a > 0 && grid_.radial_deg[r] == 0;
          for (const auto& column : values_) seen = seen && column[index] == column[first];
          if (seen) continue;
          out.angles.push_back(node);
          for (std::size_t c = 0; c < channels_.size(); ++c) out.f[c].push_back(values_[c][index]);
        }
  return out;
}

}  // namespace gonio::tabulated
