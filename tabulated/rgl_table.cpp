// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/rgl_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace gonio::tabulated {
namespace {

constexpr double pi = std::numbers::pi;

/// A pair turned or mirrored so that the azimuth of wi comes to lie in the range of the table.
DirectionPair folded(const Direction& wi, const Direction& wo, int turns, double first, double last) {
  const auto outside = [&](double sx, double sy) {
    const double phi = std::atan2(sy * wi.y(), sx * wi.x());
    double least = std::numeric_limits<double>::infinity();
    for (const double turn : {-2 * pi, 0.0, 2 * pi}) least = std::min(least, std::max({first - phi - turn, phi + turn - last, 0.0}));
    return least;
  };
  double best = outside(1, 1), x = 1, y = 1;
  for (const auto& [sx, sy] : {std::pair{-1, -1}, std::pair{-1, 1}, std::pair{1, -1}}) {
    const bool mirror = sx != sy;
    if (turns == 1 || (mirror && turns != 4)) continue;
    if (const double distance = outside(sx, sy); distance < best) best = distance, x = sx, y = sy;
  }
  return {Direction::trusted(x * wi.x(), y * wi.y(), wi.z()), Direction::trusted(x * wo.x(), y * wo.y(), wo.z())};
}

/// The four nodes around a point of a grid: the first of them and their weights.
struct Corners {
  Corners(UnitPoint at, std::size_t rows, std::size_t columns) {
    const auto cell = [](double coordinate, std::size_t nodes, std::size_t& first) {
      const double scaled = std::clamp(coordinate, 0.0, 1.0) * static_cast<double>(nodes - 1);
      first = std::min(static_cast<std::size_t>(scaled), nodes - 2);
      return scaled - static_cast<double>(first);
    };
    std::size_t row = 0, column = 0;
    const double y = cell(at.y, rows, row), x = cell(at.x, columns, column);
    low = row * columns + column;
    weight[0] = (1 - y) * (1 - x), weight[1] = (1 - y) * x, weight[2] = y * (1 - x), weight[3] = y * x;
  }

  std::size_t low;
  double weight[4];
};

/// Blocks of rows x columns numbers, each with its columns as rows.
std::vector<float> transposed(const std::vector<float>& values, std::size_t rows, std::size_t columns) {
  std::vector<float> out(values.size());
  for (std::size_t block = 0; block < values.size(); block += rows * columns)
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns; ++column) out[block + column * rows + row] = values[block + row * columns + column];
  return out;
}

/// The azimuth `phi` plus whole turns so that it lies in or nearest above `first`.
double from(double first, double phi) { return phi + 2 * pi * std::ceil((first - phi) / (2 * pi) - 1e-9); }

}  // namespace

int RglTable::turns(const std::vector<float>& phi_i) noexcept {
  if (is_isotropic(phi_i)) return 1;
  const double ratio = 2 * pi / static_cast<double>(phi_i.back() - phi_i.front());
  const double nearest = std::rint(ratio);
  constexpr double rounding_of_the_file = 1e-3;
  if (!(std::fabs(ratio - nearest) < rounding_of_the_file * nearest)) return 0;
  for (const int turns : {1, 2, 4})
    if (nearest == turns) return turns;
  return 0;
}

RglTable::RglTable(RglArrays arrays)
    : arrays_(std::move(arrays)),
      vndf_(std::exchange(arrays_.vndf, {}), arrays_.vndf_rows, arrays_.vndf_columns),
      values_(transposed(std::exchange(arrays_.values, {}), arrays_.channels.size(), arrays_.value_rows * arrays_.value_columns)),
      turns_(turns(arrays_.phi_i)) {}

RglArrays RglTable::arrays() const {
  RglArrays out = arrays_;
  out.vndf = vndf_.density();
  out.values = transposed(values_, arrays_.value_rows * arrays_.value_columns, arrays_.channels.size());
  return out;
}

UnitPoint RglTable::unit_point(double theta, double phi) const noexcept {
  const double y = (phi + pi) / (2 * pi);
  return {std::sqrt(theta * 2 / pi), y - std::floor(y)};
}

SliceWeights RglTable::slices_at(double theta_i, double phi_i) const noexcept {
  const Neighbours t = neighbours_in(arrays_.theta_i, theta_i), p = neighbours_in(arrays_.phi_i, phi_i);
  const std::size_t count = arrays_.theta_i.size();
  return {{p.low * count + t.low, p.low * count + t.high, p.high * count + t.low, p.high * count + t.high},
          {(1 - p.weight) * (1 - t.weight), (1 - p.weight) * t.weight, p.weight * (1 - t.weight), p.weight * t.weight}};
}

void RglTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  const std::size_t channel_count = arrays_.channels.size(), columns = arrays_.value_columns, rows = arrays_.value_rows;
  const double first = static_cast<double>(arrays_.phi_i.front()), last = static_cast<double>(arrays_.phi_i.back());
  const bool isotropic = is_isotropic(arrays_.phi_i), one_azimuth = arrays_.phi_i.size() == 1;
  for (std::size_t k = 0; k < wi.size(); ++k) {
    double* out = f.data() + k * channel_count;
    std::fill(out, out + channel_count, 0.0);
    if (!(wi[k].z() > 0) || !(wo[k].z() > 0)) continue;
    const auto [i, o] = turns_ == 1 ? DirectionPair{wi[k], wo[k]} : folded(wi[k], wo[k], turns_, first, last);
    const double theta_i = std::atan2(std::sqrt(i.x() * i.x() + i.y() * i.y()), i.z());
    const double azimuth = one_azimuth ? 0 : std::atan2(i.y(), i.x());  // else only relative azimuths count
    const double hx = i.x() + o.x(), hy = i.y() + o.y(), hz = i.z() + o.z();
    const double theta_m = std::atan2(std::sqrt(hx * hx + hy * hy), hz);
    const bool along_i = isotropic && (i.x() != 0 || i.y() != 0);  // the azimuth of the half vector from that of wi
    const double phi_m = along_i ? std::atan2(hy * i.x() - hx * i.y(), hx * i.x() + hy * i.y()) : std::atan2(hy, hx);

    const SliceWeights slices = slices_at(theta_i, isotropic ? azimuth : from(first, azimuth));
    const UnitPoint m = unit_point(theta_m, phi_m);
    const UnitPoint s = vndf_.invert(slices, m);
    const double ndf = bilinear(arrays_.ndf.data(), arrays_.angle_rows, arrays_.angle_columns, m);
    const double sigma = bilinear(arrays_.sigma.data(), arrays_.angle_rows, arrays_.angle_columns, unit_point(theta_i, azimuth));
    if (std::isnan(s.x)) {
      std::fill(out, out + channel_count, std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const double factor = ndf / (4 * sigma * o.z());
    const Corners corners(s, rows, columns);
    for (std::size_t n = 0; n < slices.slice.size(); ++n) {
      if (slices.weight[n] == 0) continue;
      const float* low = values_.data() + (slices.slice[n] * rows * columns + corners.low) * channel_count;
      const float* high = low + columns * channel_count;
      const double scaled = factor * slices.weight[n];
      const double w00 = scaled * corners.weight[0], w01 = scaled * corners.weight[1];
      const double w10 = scaled * corners.weight[2], w11 = scaled * corners.weight[3];
      for (std::size_t c = 0; c < channel_count; ++c)
        out[c] += w00 * static_cast<double>(low[c]) + w01 * static_cast<double>(low[channel_count + c]) +
                  w10 * static_cast<double>(high[c]) + w11 * static_cast<double>(high[channel_count + c]);
    }
  }
}

Dataset RglTable::samples() const {
  Dataset out;
  out.channels = arrays_.channels;
  out.symmetry = symmetry();
  out.f.resize(arrays_.channels.size());
  const std::size_t rows = arrays_.value_rows, columns = arrays_.value_columns, plane = rows * columns;
  const std::size_t channel_count = arrays_.channels.size();
  const bool isotropic = is_isotropic(arrays_.phi_i);
  for (std::size_t slice = 0; slice < arrays_.phi_i.size() * arrays_.theta_i.size(); ++slice) {
    const Angle theta_i = radians(static_cast<double>(arrays_.theta_i[slice % arrays_.theta_i.size()]));
    const Angle phi_i = radians(static_cast<double>(arrays_.phi_i[slice / arrays_.theta_i.size()]));
    const Direction wi = Direction::spherical(theta_i, phi_i);
    if (wi.z() < least_cosine) {
      out.masked.below_horizon += plane;
      continue;
    }
    const double sigma =
        bilinear(arrays_.sigma.data(), arrays_.angle_rows, arrays_.angle_columns, unit_point(theta_i.radians(), phi_i.radians()));
    const float* values = values_.data() + slice * channel_count * plane;
    for (std::size_t node = 0; node < plane; ++node) {
      const UnitPoint s{static_cast<double>(node % columns) / static_cast<double>(columns - 1),
                        static_cast<double>(node / columns) / static_cast<double>(rows - 1)};
      const UnitPoint u = vndf_.sample(slice, s);
      const Angle theta_m = radians(u.x * u.x * pi / 2), phi_m = radians((2 * u.y - 1) * pi + (isotropic ? phi_i.radians() : 0));
      const Direction m = Direction::spherical(theta_m, phi_m);
      const double along = 2 * dot(wi, m);
      const Direction wo = Direction::trusted(along * m.x() - wi.x(), along * m.y() - wi.y(), along * m.z() - wi.z());
      if (!(along > 0) || wo.z() < least_cosine) {
        ++out.masked.below_horizon;
        continue;
      }
      bool measured = false;
      for (std::size_t c = 0; c < channel_count; ++c) measured = measured || values[node * channel_count + c] != 0.0f;
      if (!measured) {
        ++out.masked.missing;
        continue;
      }
      const double factor = bilinear(arrays_.ndf.data(), arrays_.angle_rows, arrays_.angle_columns, u) / (4 * sigma * wo.z());
      out.angles.push_back(gonio_angles(wi, wo));
      for (std::size_t c = 0; c < channel_count; ++c) out.f[c].push_back(factor * static_cast<double>(values[node * channel_count + c]));
    }
  }
  return out;
}

}  // namespace gonio::tabulated
