// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/rgl_build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

#include "brdf/error.hpp"
#include "tabulated/formats/rgl_microsurface.hpp"
#include "tabulated/in_parallel.hpp"
#include "tabulated/node_values.hpp"

namespace gonio::tabulated {
namespace {

constexpr double pi = std::numbers::pi;
/// Values are asked for with both directions at least this far above the horizon (cosine).
constexpr double least_cosine = 1e-3;
/// Half vectors that cannot be seen keep this much density: a row without any has no inverse. Far below the rounding of float.
constexpr double hidden_cosine = 1e-9;
/// Of what the density of half vectors is made that a file is adapted to; the rest are the visible half vectors of the microsurface.
struct Shares {
  double broad;  ///< follows the horizon of each incidence
  double fixed;  ///< the same for every incidence
};
/// Without a broad share the tails of a narrow lobe, where most directions are, get a few cells together: the mean error of GGX with alpha
/// 0.1 at 32 x 64 x 64 is 2.4 % with 0, 0.09 % with 0.2.
constexpr Shares isotropic_shares{.broad = 0.2, .fixed = 0};
/// Between azimuths of incidence readers mix values at one place of the warped square, but a half vector has another place in each: less so
/// if a part of the density is fixed.
constexpr Shares anisotropic_shares{.broad = 0.2, .fixed = 0.3};

Direction raised(const Direction& w) {
  if (w.z() >= least_cosine) return w;
  const double flat = std::hypot(w.x(), w.y()), sine = std::sqrt(1 - least_cosine * least_cosine);
  return flat > 0 ? Direction::trusted(w.x() / flat * sine, w.y() / flat * sine, least_cosine) : Direction::trusted(sine, 0, least_cosine);
}

UnitPoint unit_point(const Direction& w, double turned_by) {
  const double theta = std::atan2(std::hypot(w.x(), w.y()), w.z());
  const double y = (std::atan2(w.y(), w.x()) - turned_by + pi) / (2 * pi);
  return {std::min(1.0, std::sqrt(theta * 2 / pi)), y - std::floor(y)};
}

/// One incidence: geometry that all its nodes share.
class Slice {
 public:
  Slice(const RglArrays& arrays, std::size_t index) : arrays_(arrays) {
    const double theta = static_cast<double>(arrays.theta_i[index % arrays.theta_i.size()]);
    phi_ = static_cast<double>(arrays.phi_i[index / arrays.theta_i.size()]);
    wi_ = Direction::spherical(radians(theta), radians(phi_));
    sigma_ = at(arrays.sigma, unit_point(wi_, 0));
  }

  const Direction& wi() const { return wi_; }
  Direction half_vector(UnitPoint u) const {
    return Direction::spherical(radians(u.x * u.x * pi / 2), radians((2 * u.y - 1) * pi + phi_origin()));
  }
  /// Density of visible half vectors over the square.
  double visible(UnitPoint u) const {
    return solid_angle(u) * std::max(hidden_cosine, dot(wi_, half_vector(u))) * at(arrays_.ndf, u) / sigma_;
  }
  /// Density of half vectors, to scale, of directions wo above the horizon with a density sqrt(cos theta_o).
  double broad(UnitPoint u) const {
    const Direction m = half_vector(u);
    const double cosine = dot(wi_, m), z = 2 * cosine * m.z() - wi_.z();
    return cosine > 0 && z > 0 ? solid_angle(u) * cosine * std::sqrt(z) : 0;
  }
  /// A density of half vectors, to scale, that falls as their cosine.
  static double fixed(UnitPoint u) { return solid_angle(u) * std::cos(u.x * u.x * pi / 2); }
  /// What makes the ratio to the single scattering of the microsurface from f, the cosine of wo left out: 4 sigma(wi) / ndf(m).
  double ratio_factor(const Direction& m) const { return 4 * sigma_ / at(arrays_.ndf, unit_point(m, phi_origin())); }

 private:
  /// Of the directions around a point of the square, per area.
  static double solid_angle(UnitPoint u) { return 2 * pi * pi * u.x * std::sin(u.x * u.x * pi / 2); }
  /// Azimuths of half vectors are relative to the incidence in an isotropic file.
  double phi_origin() const { return arrays_.phi_i.size() == 1 ? phi_ : 0; }
  double at(const std::vector<float>& values, UnitPoint u) const {
    return bilinear(values.data(), arrays_.angle_rows, arrays_.angle_columns, u);
  }

  const RglArrays& arrays_;
  Direction wi_;
  double phi_ = 0, sigma_ = 1;
};

UnitPoint node(std::size_t k, std::size_t columns, std::size_t rows) {
  return {static_cast<double>(k % columns) / static_cast<double>(columns - 1),
          static_cast<double>(k / columns) / static_cast<double>(rows - 1)};
}

/// Densities of half vectors over the square for every slice.
struct Densities {
  std::vector<float> visible;  ///< of the microsurface, to scale
  std::vector<float> written;  ///< the same with the other shares
};

Densities densities(const RglArrays& arrays, int threads) {
  const std::size_t size = arrays.vndf_rows * arrays.vndf_columns, slices = arrays.phi_i.size() * arrays.theta_i.size();
  Densities out{std::vector<float>(slices * size), std::vector<float>(slices * size)};
  const Shares shares = arrays.phi_i.size() == 1 ? isotropic_shares : anisotropic_shares;
  in_parallel(slices, threads, [&](std::size_t index) {
    const Slice slice(arrays, index);
    float* const visible = out.visible.data() + index * size;
    std::vector<double> broad(size), fixed(size);
    double visible_sum = 0, broad_sum = 0, fixed_sum = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const UnitPoint u = node(k, arrays.vndf_columns, arrays.vndf_rows);
      visible[k] = static_cast<float>(slice.visible(u)), visible_sum += static_cast<double>(visible[k]);
      broad[k] = slice.broad(u), broad_sum += broad[k];
      fixed[k] = Slice::fixed(u), fixed_sum += fixed[k];
    }
    const double of_visible = (1 - shares.broad - shares.fixed) / visible_sum, of_fixed = shares.fixed / fixed_sum;
    const double of_broad = broad_sum > 0 ? shares.broad / broad_sum : 0;  // nothing at all is above the horizon at grazing incidence
    for (std::size_t k = 0; k < size; ++k)
      out.written[index * size + k] =
          static_cast<float>(of_visible * static_cast<double>(visible[k]) + of_broad * broad[k] + of_fixed * fixed[k]);
  });
  return out;
}

/// An unknown node takes the mean of its known neighbours, ring by ring; false if nothing is known.
bool fill_in(float* values, std::size_t side) {
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < side * side; ++k)
    if (std::isnan(values[k])) missing.push_back(k);
  while (!missing.empty()) {
    std::vector<std::pair<std::size_t, float>> found;
    std::vector<std::size_t> still;
    for (const std::size_t k : missing) {
      float sum = 0, count = 0;
      const auto add = [&](bool inside, std::size_t at) {
        if (inside && !std::isnan(values[at])) sum += values[at], ++count;
      };
      add(k % side > 0, k - 1);
      add(k % side + 1 < side, k + 1);
      add(k >= side, k - side);
      add(k + side < side * side, k + side);
      if (count > 0)
        found.emplace_back(k, sum / count);
      else
        still.push_back(k);
    }
    if (found.empty()) return false;
    for (const auto& [k, value] : found) values[k] = value;
    missing = std::move(still);
  }
  return true;
}

/// Fills `values` and `luminance` of arrays that are complete otherwise: first with the ratio of f to the microsurface, which is smooth,
/// then with the cosine of the node.
class ValueBuilder {
 public:
  /// `visible` is the density without the broad share.
  ValueBuilder(const Opened& source, const ChannelMap& map, const std::vector<float>& visible, int threads, RglArrays& arrays)
      : source_(source),
        map_(map),
        luminance_(map_to_luminance(source.brdf->channels())),
        visible_(visible),
        warp_(arrays.vndf, arrays.vndf_rows, arrays.vndf_columns),
        threads_(threads),
        arrays_(arrays),
        side_(arrays.value_rows),
        plane_(side_ * side_),
        thetas_(arrays.theta_i.size()),
        slices_(arrays.phi_i.size() * thetas_) {
    arrays.values.resize(slices_ * map.to.size() * plane_);
    arrays.luminance.resize(slices_ * plane_);
  }

  void build(ExportNotes& notes) {
    for (std::size_t p = 0; p < arrays_.phi_i.size(); ++p) evaluate(p, notes);
    if (arrays_.phi_i.size() == 1) average_mirror_images(notes);
    fill_unknown();
    light_up_dark_slices();
  }

 private:
  float* values_of(std::size_t slice, std::size_t channel) { return arrays_.values.data() + (slice * map_.to.size() + channel) * plane_; }
  float* luminance_of(std::size_t slice) { return arrays_.luminance.data() + slice * plane_; }

  double density_at(const std::vector<float>& density, std::size_t slice, UnitPoint u) const {
    const std::size_t rows = arrays_.vndf_rows, columns = arrays_.vndf_columns;
    return bilinear(density.data() + slice * rows * columns, rows, columns, u);
  }

  /// Values and luminance of one azimuth of incidence. Samples fall with the density of the file, so that the luminance they are thinned
  /// out by is f cos theta_o over that density.
  void evaluate(std::size_t p, ExportNotes& notes) {
    std::vector<Direction> wi(thetas_ * plane_), wo(wi);
    std::vector<double> factor(wi.size()), visible_share(wi.size()), height(wi.size());
    in_parallel(thetas_, threads_, [&](std::size_t t) {
      const std::size_t index = p * thetas_ + t;
      const Slice slice(arrays_, index);
      const Direction& i = slice.wi();
      for (std::size_t k = 0; k < plane_; ++k) {
        const UnitPoint u = warp_.sample(index, node(k, side_, side_));
        const Direction m = slice.half_vector(u);
        const double along = 2 * dot(i, m);
        const Direction out = Direction::trusted(along * m.x() - i.x(), along * m.y() - i.y(), along * m.z() - i.z());
        const std::size_t n = t * plane_ + k;
        wi[n] = raised(i), wo[n] = raised(out);
        factor[n] = slice.ratio_factor(m) * wo[n].z();
        visible_share[n] = density_at(visible_, index, u) / density_at(arrays_.vndf, index, u);
        height[n] = out.z();
        if (!(out.z() > 0)) ++below_horizon_;
      }
    });
    const NodeValues values = node_values(source_, wi, wo, threads_, notes);
    notes.n_below_horizon = below_horizon_;
    in_parallel(thetas_, threads_, [&](std::size_t t) {
      std::vector<double> f(values.channel_count), mapped(map_.to.size());
      for (std::size_t k = 0; k < plane_; ++k) {
        const std::size_t n = t * plane_ + k, slice = p * thetas_ + t;
        for (std::size_t c = 0; c < f.size(); ++c) {
          const double value = values.f[n * f.size() + c];
          f[c] = value < 0 ? 0 : value * factor[n];  // NaN stays
        }
        map_.apply(f.data(), mapped.data());
        for (std::size_t c = 0; c < mapped.size(); ++c) values_of(slice, c)[k] = static_cast<float>(mapped[c]);
        double y = 0;
        luminance_.apply(f.data(), &y);
        luminance_of(slice)[k] = static_cast<float>(y * visible_share[n]);
      }
      for (std::size_t c = 0; c < mapped.size(); ++c) cross_horizon(height.data() + t * plane_, values_of(p * thetas_ + t, c));
    });
  }

  /// f cos theta_o vanishes at the horizon, which runs between nodes: those next to it on the far side are 0. The value of the raised
  /// direction, over the small density of half vectors there, would light a seam along the terminator of every body; numbers below 0 that
  /// put the crossing where it belongs are refused as light by renderers. Nodes farther below, which no direction above uses, keep theirs.
  void cross_horizon(const double* height, float* values) const {
    const auto touches_light = [&](std::size_t row, std::size_t column) {
      for (std::size_t r = std::max<std::size_t>(row, 1) - 1; r <= std::min(row + 1, side_ - 1); ++r)
        for (std::size_t c = std::max<std::size_t>(column, 1) - 1; c <= std::min(column + 1, side_ - 1); ++c)
          if (height[r * side_ + c] > 0) return true;
      return false;
    };
    for (std::size_t row = 0; row < side_; ++row)
      for (std::size_t column = 0; column < side_; ++column)
        if (!(height[row * side_ + column] > 0) && touches_light(row, column)) values[row * side_ + column] = 0;
  }

  /// The azimuth of half vectors runs down the rows, and the density is symmetric: node and mirror image are as far from both ends.
  void average_mirror_images(ExportNotes& notes) {
    double difference = 0, sum = 0;
    const auto average = [&](float* values, bool counts) {
      for (std::size_t row = 0; row < side_ / 2; ++row)
        for (std::size_t column = 0; column < side_; ++column) {
          float &a = values[row * side_ + column], &b = values[(side_ - 1 - row) * side_ + column];
          if (!std::isnan(a) && !std::isnan(b)) {
            if (counts) difference += static_cast<double>(std::fabs(a - b)), sum += static_cast<double>(std::fabs(a) + std::fabs(b));
            a = b = 0.5f * (a + b);
          } else {
            a = b = std::isnan(a) ? b : a;
          }
        }
    };
    for (std::size_t slice = 0; slice < slices_; ++slice) {
      for (std::size_t c = 0; c < map_.to.size(); ++c) average(values_of(slice, c), false);
      average(luminance_of(slice), true);
    }
    constexpr double rounding = 1e-5;
    if (difference > rounding * sum)
      notes.lost.push_back(fmt::format(
          "values left and right of the plane of incidence, which differ by {:.2g} % on average, are averaged: renderers may mirror an "
          "isotropic file",
          200 * difference / sum));
  }

  void fill_unknown() {
    std::vector<char> filled(slices_);
    in_parallel(slices_, threads_, [&](std::size_t slice) {
      bool all = fill_in(luminance_of(slice), side_);
      for (std::size_t c = 0; c < map_.to.size(); ++c) all = fill_in(values_of(slice, c), side_) && all;
      filled[slice] = all;
    });
    for (std::size_t slice = 0; slice < slices_; ++slice) {
      if (filled[slice]) continue;
      const std::size_t from = nearest_filled(filled, slice);
      std::copy_n(values_of(from, 0), map_.to.size() * plane_, values_of(slice, 0));
      std::copy_n(luminance_of(from), plane_, luminance_of(slice));
    }
  }

  /// The slice with the nearest azimuth, then the nearest zenith angle, of which something is known.
  std::size_t nearest_filled(const std::vector<char>& filled, std::size_t slice) const {
    const auto distance = [&](std::size_t other) {
      const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
      return apart(slice / thetas_, other / thetas_) * thetas_ + apart(slice % thetas_, other % thetas_);
    };
    std::size_t best = slices_;
    for (std::size_t other = 0; other < slices_; ++other)
      if (filled[other] && (best == slices_ || distance(other) < distance(best))) best = other;
    if (best == slices_)
      throw Error(ErrorKind::input, {"the BRDF to be written", "no value known at any node of the grid", "at least one value"});
    return best;
  }

  /// Readers divide the luminance by its sum.
  void light_up_dark_slices() {
    for (std::size_t slice = 0; slice < slices_; ++slice) {
      float* luminance = luminance_of(slice);
      std::for_each(luminance, luminance + plane_, [](float& value) { value = std::max(0.0f, value); });
      if (std::all_of(luminance, luminance + plane_, [](float value) { return value == 0; })) std::fill_n(luminance, plane_, 1.0f);
    }
  }

  const Opened& source_;
  const ChannelMap& map_;
  ChannelMap luminance_;
  const std::vector<float>& visible_;
  MarginalWarp warp_;
  int threads_;
  RglArrays& arrays_;
  std::size_t side_, plane_, thetas_, slices_;
  std::atomic<std::size_t> below_horizon_{0};
};

}  // namespace

std::size_t RglGrid::bytes(std::size_t channel_count) const noexcept {
  const std::size_t slice = density_count * density_count + (channel_count + 1) * value_count * value_count;
  return sizeof(float) * (phi_count * theta_count * slice + 2 * normal_rows * normal_columns);
}

RglGrid rgl_grid(GridSize size, bool isotropic) {
  switch (size) {
    case GridSize::paper: return isotropic ? RglGrid{1, 8, 32, 128, 2, 128} : RglGrid{17, 8, 32, 64, 129, 128};
    case GridSize::standard: return isotropic ? RglGrid{1, 32, 64, 128, 2, 128} : RglGrid{33, 16, 48, 64, 129, 128};
    case GridSize::fine: return isotropic ? RglGrid{1, 64, 128, 256, 2, 128} : RglGrid{65, 16, 64, 64, 129, 128};
  }
  return {};
}

std::string words(const RglGrid& grid) {
  return fmt::format("{}{} x {} x {}", grid.phi_count == 1 ? "" : fmt::format("{} x ", grid.phi_count), grid.theta_count, grid.value_count,
                     grid.value_count);
}

RglArrays build_rgl(const Opened& source, const RglGrid& grid, const ChannelMap& map, int threads, ExportNotes& notes) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {"the source", fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  const Microsurface surface = microsurface_of(retro_reflection(source, grid.normal_rows, grid.normal_columns, threads, notes),
                                               grid.normal_rows, grid.normal_columns, threads);
  RglArrays out;
  out.channels = map.to;
  out.theta_i = incidences_of(surface, grid.theta_count);
  for (std::size_t p = 0; p < grid.phi_count; ++p)
    out.phi_i.push_back(
        grid.phi_count == 1 ? 0 : static_cast<float>((2 * static_cast<double>(p) / static_cast<double>(grid.phi_count - 1) - 1) * pi));
  out.angle_rows = surface.rows, out.angle_columns = surface.columns;
  out.ndf = surface.ndf, out.sigma = surface.sigma;
  out.vndf_rows = out.vndf_columns = grid.density_count;
  Densities half_vectors = densities(out, threads);
  out.vndf = std::move(half_vectors.written);
  out.value_rows = out.value_columns = grid.value_count;
  ValueBuilder(source, map, half_vectors.visible, threads, out).build(notes);
  return out;
}

}  // namespace gonio::tabulated
