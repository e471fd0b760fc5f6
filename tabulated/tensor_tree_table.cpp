// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/tensor_tree_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tabulated/disk_square.hpp"
#include "tabulated/radiance_colour.hpp"

namespace gonio::tabulated {
namespace {

/// The direction above a point of the unit disk.
Direction above(double x, double y) noexcept { return Direction::trusted(x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))); }

}  // namespace

TensorTree::Position tree_position(std::size_t dimensions, const Direction& wi, const Direction& wo, double y_sign) noexcept {
  const double ix = wi.x(), iy = y_sign * wi.y(), ox = wo.x(), oy = y_sign * wo.y();
  if (dimensions == 4) {
    const auto in = square_of_disk(-ix, -iy), out = square_of_disk(ox, oy);
    return {in[0], in[1], out[0], out[1]};
  }
  const double sine = std::hypot(ix, iy);
  const double c = sine > 0 ? -ix / sine : 1, s = sine > 0 ? -iy / sine : 0;  // azimuth of the light's shadow
  const auto out = square_of_disk(c * ox + s * oy, c * oy - s * ox);
  // Just below one half at normal incidence: the upper half of the cube is empty.
  return {std::min(0.5 * (1 - sine), std::nextafter(0.5, 0.0)), out[0], out[1], 0};
}

DirectionPair tree_directions(std::size_t dimensions, const TensorTree::Position& at, double y_sign) noexcept {
  if (dimensions == 4) {
    const auto in = disk_of_square(at[0], at[1]), out = disk_of_square(at[2], at[3]);
    return {above(-in[0], -y_sign * in[1]), above(out[0], y_sign * out[1])};
  }
  const auto out = disk_of_square(at[1], at[2]);
  return {above(-(1 - 2 * at[0]), 0), above(out[0], y_sign * out[1])};
}

TensorTreeTable::TensorTreeTable(TreeChannels trees, SheetSide side)
    : trees_(std::move(trees)), side_(side), channels_(trees_.u ? rgb_channels() : single_channel("Y")) {}

void TensorTreeTable::value(const TensorTree::Position& at, double* out) const {
  const double luminance = trees_.luminance.at(at);
  if (!trees_.u) {
    *out = luminance;
    return;
  }
  const double v = trees_.v->at(at);
  if (luminance == 0 || !(v > 0)) {  // black has no colour; a luminance without a colour is unknown
    std::fill_n(out, 3, luminance == 0 ? 0.0 : std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const auto rgb = rgb_of_xyz(xyz_of_yuv(luminance, trees_.u->at(at), v));
  std::copy(rgb.begin(), rgb.end(), out);
}

void TensorTreeTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  const std::size_t channel_count = channels_.size();
  for (std::size_t k = 0; k < wi.size(); ++k) {
    double* const out = f.data() + k * channel_count;
    if (side_.holds(wi[k], wo[k]))
      value(tree_position(trees_.luminance.dimensions(), wi[k], wo[k], side_.y_sign()), out);
    else
      std::fill_n(out, channel_count, 0.0);
  }
}

Dataset TensorTreeTable::samples() const {
  Dataset out;
  out.channels = channels_;
  out.symmetry = symmetry();
  out.side = side_.kind;
  out.f.resize(channels_.size());
  const std::size_t dimensions = trees_.luminance.dimensions();
  std::vector<double> f(channels_.size());
  trees_.luminance.visit([&](const TensorTree::Position& corner, double edge, float) {
    TensorTree::Position centre{};
    for (std::size_t i = 0; i < dimensions; ++i) centre[i] = corner[i] + edge / 2;
    if (dimensions == 3) {  // the upper half of the first dimension is empty
      if (corner[0] >= 0.5) return;
      centre[0] = 0.5 * (corner[0] + std::min(corner[0] + edge, 0.5));
    }
    const DirectionPair pair = tree_directions(dimensions, centre, side_.y_sign());
    const Direction wo = side_.kind == Side::reflection ? pair.wo : Direction::trusted(pair.wo.x(), pair.wo.y(), -pair.wo.z());
    value(centre, f.data());
    out.angles.push_back(gonio_angles(pair.wi, wo));
    for (std::size_t c = 0; c < f.size(); ++c) out.f[c].push_back(f[c]);
  });
  return out;
}

}  // namespace gonio::tabulated
