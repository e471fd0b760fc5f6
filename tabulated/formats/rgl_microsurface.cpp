// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/rgl_microsurface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/coordinates.hpp"
#include "brdf/error.hpp"
#include "tabulated/channel_map.hpp"
#include "tabulated/in_parallel.hpp"
#include "tabulated/node_values.hpp"

namespace gonio::tabulated {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int power_iterations = 4;
/// Of the largest value.
constexpr double least_ndf = 1e-5;
/// Retro-reflection is asked for up to this angle above the horizon [rad].
constexpr double from_horizon = 1e-3;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double theta_of(std::size_t column, std::size_t columns) {
  const double u = static_cast<double>(column) / static_cast<double>(columns - 1);
  return u * u * pi / 2;
}
double phi_of(std::size_t row, std::size_t rows) { return (2 * static_cast<double>(row) / static_cast<double>(rows - 1) - 1) * pi; }

/// ∫ max(0, a + b cos phi) dphi over a whole turn, b >= 0: the normals of one zenith angle.
double turned(double a, double b) {
  if (a >= b) return 2 * pi * a;
  const double edge = std::atan2(std::sqrt((b - a) * (b + a)), -a);
  return 2 * (a * edge + b * std::sin(edge));
}

/// sigma(w) = ∫ max(0, w·m) D(m) dm on the nodes of theta, at each step of azimuth; one step, the whole turn, where nothing depends on it.
class Projection {
 public:
  Projection(std::size_t rows, std::size_t columns, int threads)
      : steps_(rows == 2 ? 1 : rows - 1), columns_(columns), threads_(threads), area_(columns), cosine_(steps_ * columns * columns) {
    const double step = 1 / static_cast<double>(columns - 1), dphi = 2 * pi / static_cast<double>(steps_);
    for (std::size_t j = 0; j < columns; ++j)
      area_[j] = (j == 0 || j + 1 == columns ? 0.5 : 1.0) * step * pi * static_cast<double>(j) * step * std::sin(theta_of(j, columns));
    in_parallel(columns, threads, [&](std::size_t j) {
      for (std::size_t i = 0; i < columns; ++i) {
        const double ti = theta_of(i, columns), tj = theta_of(j, columns);
        const double a = std::cos(ti) * std::cos(tj), b = std::sin(ti) * std::sin(tj);
        for (std::size_t s = 0; s < steps_; ++s)
          cosine_[(s * columns + j) * columns + i] =
              steps_ == 1 ? turned(a, b) : dphi * std::max(0.0, a + b * std::cos(static_cast<double>(s) * dphi));
      }
    });
  }

  /// sigma of a distribution, [step][column] both.
  std::vector<double> of(const std::vector<double>& ndf) const {
    constexpr std::size_t together = 16;  // azimuths for which one step of the kernel stays in the cache
    std::vector<double> out(steps_ * columns_);
    in_parallel((steps_ + together - 1) / together, threads_, [&](std::size_t block) {
      const std::size_t end = std::min(steps_, (block + 1) * together);
      for (std::size_t s = 0; s < steps_; ++s)
        for (std::size_t p = block * together; p < end; ++p)
          add(cosine_.data() + s * columns_ * columns_, ndf.data() + (p + s) % steps_ * columns_, out.data() + p * columns_);
    });
    return out;
  }

  std::size_t steps() const { return steps_; }

 private:
  /// What normals of one azimuth add to directions of another.
  void add(const double* cosine, const double* ndf, double* sigma) const {
    for (std::size_t j = 0; j < columns_; ++j, cosine += columns_) {
      const double density = ndf[j] * area_[j];
      for (std::size_t i = 0; i < columns_; ++i) sigma[i] += density * cosine[i];
    }
  }

  std::size_t steps_, columns_;
  int threads_;
  std::vector<double> area_;    ///< [column] solid angle of a node per radian of azimuth
  std::vector<double> cosine_;  ///< [step][column of m][column of w] max(0, w·m) times the step of azimuth
};

struct Nodes {
  std::vector<Direction> wi, wo;
  std::vector<std::size_t> at;
};

/// Luminance times cos theta_o of pairs; unknown ones are left as they are.
void ask(const Opened& source, const ChannelMap& luminance, const Nodes& nodes, int threads, std::vector<double>& out) {
  ExportNotes not_nodes_of_the_file;
  const NodeValues values = node_values(source, nodes.wi, nodes.wo, threads, not_nodes_of_the_file);
  for (std::size_t k = 0; k < nodes.at.size(); ++k) {
    double y = unknown;
    luminance.apply(values.f.data() + k * values.channel_count, &y);
    if (!std::isnan(y)) out[nodes.at[k]] = std::max(0.0, y) * std::max(nodes.wo[k].z(), std::sin(from_horizon));
  }
}

/// Fills the unknown values of a row from the known ones beside them; false if there are none.
bool fill_along(double* row, std::size_t columns) {
  std::size_t last = columns;
  for (std::size_t k = 0; k < columns; ++k) {
    if (std::isnan(row[k])) continue;
    for (std::size_t j = last == columns ? 0 : last + 1; j < k; ++j) {
      const double part = last == columns ? 1 : static_cast<double>(j - last) / static_cast<double>(k - last);
      row[j] = last == columns ? row[k] : (1 - part) * row[last] + part * row[k];
    }
    last = k;
  }
  for (std::size_t j = last + 1; last != columns && j < columns; ++j) row[j] = row[last];
  return last != columns;
}

}  // namespace

std::vector<double> retro_reflection(const Opened& source, std::size_t rows, std::size_t columns, int threads, ExportNotes& notes) {
  const ChannelMap luminance = map_to_luminance(source.brdf->channels());
  const std::size_t azimuths = rows == 2 ? 1 : rows - 1;
  std::vector<double> out(azimuths * columns, unknown);
  std::size_t unknown_retro = 0;
  // The first pair is that of retro-reflection; then the directions open across the plane of the half vector, which keeps both high.
  for (const double theta_d_deg : {0.0, 2.5, 5.0, 7.5, 10.0, 15.0, 20.0, 30.0, 45.0}) {
    Nodes nodes;
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (!std::isnan(out[k])) continue;
      const double theta = std::min(theta_of(k % columns, columns), pi / 2 - from_horizon);
      const double phi = azimuths == 1 ? 0 : phi_of(k / columns, rows);
      const DirectionPair pair = directions({radians(theta), radians(phi), degrees(theta_d_deg), degrees(90)});
      nodes.wi.push_back(pair.wi), nodes.wo.push_back(pair.wo), nodes.at.push_back(k);
    }
    if (theta_d_deg > 0) unknown_retro = std::max(unknown_retro, nodes.at.size());
    if (nodes.at.empty()) break;
    ask(source, luminance, nodes, threads, out);
  }
  std::vector<bool> known;
  for (std::size_t p = 0; p < azimuths; ++p) known.push_back(fill_along(out.data() + p * columns, columns));
  const auto any = std::find(known.begin(), known.end(), true);
  if (any == known.end())
    throw Error(ErrorKind::input, {"the BRDF to be written", "nothing known of retro-reflection nor of pairs within 90 deg",
                                   "values from which the distribution of normals can be found"});
  for (std::size_t p = 0; p < azimuths; ++p) {  // an azimuth of which nothing is known takes the next that is
    std::size_t from = p;
    while (!known[from]) from = (from + 1) % azimuths;
    if (from != p)
      std::copy_n(out.begin() + static_cast<std::ptrdiff_t>(from * columns), columns,
                  out.begin() + static_cast<std::ptrdiff_t>(p * columns));
  }
  if (unknown_retro > 0)
    notes.facts.emplace_back("retro-reflection",
                             fmt::format("unknown at {} of {} nodes: the distribution of normals there is from pairs with the "
                                         "same half vector, or interpolated",
                                         unknown_retro, out.size()));
  if (std::all_of(out.begin(), out.end(), [](double value) { return value == 0; })) {
    notes.facts.emplace_back("retro-reflection", "none: the grid is that of a matt surface");
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::cos(std::min(theta_of(k % columns, columns), pi / 2 - from_horizon));
  }
  return out;
}

Microsurface microsurface_of(const std::vector<double>& retro, std::size_t rows, std::size_t columns, int threads) {
  const Projection projection(rows, columns, threads);
  std::vector<double> ndf(retro.size(), 1.0);
  const auto scale_to_peak = [&] {
    const double peak = *std::max_element(ndf.begin(), ndf.end());
    for (double& value : ndf) value /= peak;
  };
  for (int step = 0; step < power_iterations; ++step) {
    const std::vector<double> sigma = projection.of(ndf);
    for (std::size_t k = 0; k < ndf.size(); ++k) ndf[k] = retro[k] * sigma[k];
    scale_to_peak();
  }
  for (double& value : ndf) value = std::max(value, least_ndf);
  const std::vector<double> sigma = projection.of(ndf);

  Microsurface out{.rows = rows, .columns = columns, .ndf = {}, .sigma = {}};
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t k = row % projection.steps() * columns + column;
      out.ndf.push_back(static_cast<float>(ndf[k] / sigma[0]));
      out.sigma.push_back(static_cast<float>(sigma[k] / sigma[0]));
    }
  return out;
}

std::vector<float> incidences_of(const Microsurface& surface, std::size_t count) {
  // Of equal rows the last is the first again.
  const std::size_t azimuths = surface.rows - 1;
  std::vector<double> fallen(surface.columns);  // by how much sigma has fallen, never less than before
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < surface.columns; ++k) {
    double sum = 0;
    for (std::size_t p = 0; p < azimuths; ++p) sum += static_cast<double>(surface.sigma[p * surface.columns + k]);
    lowest = std::min(lowest, sum);
    fallen[k] = lowest;
  }
  // A share of evenly spaced angles keeps the angles apart where sigma does not fall at all.
  constexpr double share = 1e-6;
  const double first = fallen.front();
  for (std::size_t k = 0; k < surface.columns; ++k) fallen[k] = (first - fallen[k]) / first + share * theta_of(k, surface.columns);

  std::vector<float> out{0.0f};
  for (std::size_t n = 1; n + 1 < count; ++n) {
    const double wanted = fallen.back() * static_cast<double>(n) / static_cast<double>(count - 1);
    const auto above = std::upper_bound(fallen.begin(), fallen.end() - 1, wanted);
    const auto k = static_cast<std::size_t>(above - fallen.begin());
    const double part = std::clamp((wanted - fallen[k - 1]) / (fallen[k] - fallen[k - 1]), 0.0, 1.0);
    const double u = (static_cast<double>(k - 1) + part) / static_cast<double>(surface.columns - 1);
    out.push_back(static_cast<float>(u * u * pi / 2));
  }
  out.push_back(static_cast<float>(pi / 2));
  return out;
}

}  // namespace gonio::tabulated
