// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/rgl_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
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

/// Blocks of rows x columns numbers, each with its columns as rows.
template <class Out, class In>
Out transposed(const In& values, std::size_t rows, std::size_t columns) {
  Out out(values.size());
  for (std::size_t block = 0; block < values.size(); block += rows * columns)
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns; ++column) out[block + column * rows + row] = values[block + row * columns + column];
  return out;
}

double wrapped(double turns) { return turns - std::floor(turns); }

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
      values_(transposed<LargeArray<float>>(std::exchange(arrays_.values, {}), arrays_.channels.size(),
                                            arrays_.value_rows * arrays_.value_columns)),
      turns_(turns(arrays_.phi_i)) {}

RglArrays RglTable::arrays() const {
  RglArrays out = arrays_;
  out.vndf = vndf_.density();
  out.values = transposed<std::vector<float>>(values_, arrays_.value_rows * arrays_.value_columns, arrays_.channels.size());
  return out;
}

UnitPoint RglTable::unit_point(double theta, double phi) const noexcept {
  return {std::sqrt(theta * 2 / pi), wrapped((phi + pi) / (2 * pi))};
}

void RglTable::find_slices(double theta_i, double phi_i, SliceWeights& out) const noexcept {
  const Neighbours t = neighbours_in(arrays_.theta_i, theta_i);
  if (arrays_.phi_i.size() == 1) {
    out = {{t.low, t.high, 0, 0}, {1 - t.weight, t.weight, 0, 0}};
    return;
  }
  const Neighbours p = neighbours_in(arrays_.phi_i, phi_i);
  const std::size_t count = arrays_.theta_i.size();
  out = {{p.low * count + t.low, p.low * count + t.high, p.high * count + t.low, p.high * count + t.high},
         {(1 - p.weight) * (1 - t.weight), (1 - p.weight) * t.weight, p.weight * (1 - t.weight), p.weight * t.weight}};
}

/// ndf(m) / (4 sigma(wi) cos theta_o), by which interpolated values are to be multiplied.
void RglTable::find_factors(const RglPairs& pairs, SquareColumn& out) const noexcept {
  const std::size_t columns = arrays_.angle_columns;
  const auto between = [columns](const std::vector<float>& values, const SquareCells& cells, std::size_t k) {
    const float *const low = values.data() + cells.node[k], *const high = low + columns;
    const double x = cells.x[k], y = cells.y[k];
    const double first = (1 - y) * static_cast<double>(low[0]) + y * static_cast<double>(high[0]);
    const double last = (1 - y) * static_cast<double>(low[1]) + y * static_cast<double>(high[1]);
    return (1 - x) * first + x * last;
  };
  SquareCells half, incident;
  find_square_cells(pairs.half_y, pairs.half_x, pairs.count, arrays_.angle_rows, columns, half);
  find_square_cells(pairs.incident_y, pairs.incident_x, pairs.count, arrays_.angle_rows, columns, incident);
  for (std::size_t k = 0; k < pairs.count; ++k)
    out[k] = between(arrays_.ndf, half, k) / (4 * between(arrays_.sigma, incident, k) * pairs.oz[k]);
}

template <class Place>
void RglTable::look_up(RglPairs& pairs, Place&& place) const {
  const std::size_t channels = arrays_.channels.size(), columns = arrays_.value_columns, plane = arrays_.value_rows * columns;
  const bool isotropic = is_isotropic(arrays_.phi_i);
  // In steps over all pairs, so that the memory one pair waits for comes while others are worked on.
  find_coordinates(pairs, isotropic);
  SquareCells half, value;
  find_square_cells(pairs.half_y, pairs.half_x, pairs.count, arrays_.vndf_rows, arrays_.vndf_columns, half);
  std::array<SliceWeights, RglPairs::most> slices;
  for (std::size_t k = 0; k < pairs.count; ++k) {
    const double azimuth = 2 * pi * pairs.turn_i[k];
    find_slices(pairs.theta_i[k], isotropic ? azimuth : from(static_cast<double>(arrays_.phi_i.front()), azimuth), slices[k]);
    vndf_.prefetch(slices[k], half.node[k]);
  }
  SquareColumn factor, y, x;
  find_factors(pairs, factor);
  vndf_.invert(slices.data(), half, pairs.count, y, x);
  find_square_cells(y, x, pairs.count, arrays_.value_rows, columns, value);

  const auto first_value = [&](std::size_t k, std::size_t n) {
    return values_.data() + (slices[k].slice[n] * plane + value.node[k]) * channels;
  };
  for (std::size_t k = 0; k < pairs.count; ++k)
    for (std::size_t n = 0; n < slices[k].slice.size(); ++n) {
      if (slices[k].weight[n] == 0) continue;
      __builtin_prefetch(first_value(k, n));
      __builtin_prefetch(first_value(k, n) + columns * channels);
    }
  const auto interpolate = [&](std::size_t k, auto count, auto& sum) {
    for (std::size_t n = 0; n < slices[k].slice.size(); ++n) {
      if (slices[k].weight[n] == 0) continue;
      const float *const low = first_value(k, n), *const high = low + columns * channels;
      const double scaled = factor[k] * slices[k].weight[n];
      const double of_high = scaled * value.y[k], w11 = of_high * value.x[k], w10 = of_high - w11;
      const double of_low = scaled - of_high, w01 = of_low * value.x[k], w00 = of_low - w01;
      for (std::size_t c = 0; c < count; ++c)
        sum[c] += w00 * static_cast<double>(low[c]) + w01 * static_cast<double>(low[count + c]) + w10 * static_cast<double>(high[c]) +
                  w11 * static_cast<double>(high[count + c]);
    }
  };
  for (std::size_t k = 0; k < pairs.count; ++k) {
    double* const out = place(k);
    if (channels == 3) {
      double rgb[3] = {};
      interpolate(k, std::integral_constant<std::size_t, 3>{}, rgb);  // loops that the compiler unrolls
      std::copy_n(rgb, 3, out);
    } else {
      std::fill_n(out, channels, 0.0);
      interpolate(k, channels, out);
    }
  }
}

void RglTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  const double first = static_cast<double>(arrays_.phi_i.front()), last = static_cast<double>(arrays_.phi_i.back());
  const std::size_t channel_count = arrays_.channels.size();
  RglPairs pairs;
  std::array<std::size_t, RglPairs::most> places;
  const auto flush = [&] {
    look_up(pairs, [&](std::size_t k) { return f.data() + places[k] * channel_count; });
    pairs.count = 0;
  };
  for (std::size_t k = 0; k < wi.size(); ++k) {
    if (!(wi[k].z() > 0) || !(wo[k].z() > 0)) {
      std::fill_n(f.data() + k * channel_count, channel_count, 0.0);
      continue;
    }
    const std::size_t n = pairs.count++;
    places[n] = k;
    const auto add = [&](const Direction& i, const Direction& o) {
      pairs.ix[n] = i.x(), pairs.iy[n] = i.y(), pairs.iz[n] = i.z();
      pairs.ox[n] = o.x(), pairs.oy[n] = o.y(), pairs.oz[n] = o.z();
    };
    if (turns_ == 1) {
      add(wi[k], wo[k]);
    } else {
      const DirectionPair pair = folded(wi[k], wo[k], turns_, first, last);
      add(pair.wi, pair.wo);
    }
    if (pairs.count == RglPairs::most) flush();
  }
  if (pairs.count > 0) flush();
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
