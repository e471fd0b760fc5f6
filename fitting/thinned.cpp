// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/thinned.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace gonio::fitting {
namespace {

/// Cells per octave of sin²/2 of an angle, from 1e-9 to 1: two per octave of the angle.
int octave(double log_cos) {
  if (!(log_cos > LobeGeometry::no_lobe)) return 99;
  int exponent = 0;
  const double mantissa = std::frexp(std::clamp(-log_cos, 1e-9, 10.0), &exponent);
  return mantissa < std::numbers::sqrt2 / 2 ? exponent - 1 : exponent;
}

long cell_of(const LobeGeometry& g) {
  const long h = octave(g.log_cos_h) + 40, psi = octave(g.log_cos_psi) + 40, incidence = std::lround(4 * (1 - g.cos_i));
  return (h * 256 + psi) * 16 + incidence;
}

}  // namespace

Terms thinned(const Terms& terms, std::size_t most) {
  if (terms.rows() <= most) return terms;
  std::map<long, std::vector<std::size_t>> cells;
  for (std::size_t row = 0; row < terms.rows(); ++row) cells[cell_of(terms.geometry[row])].push_back(row);
  // Small cells whole, large ones cut to the same size.
  std::vector<std::size_t> sizes;
  for (const auto& [cell, rows] : cells) sizes.push_back(rows.size());
  std::sort(sizes.begin(), sizes.end());
  std::size_t left = most, limit = 1;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    limit = std::max<std::size_t>(1, left / (sizes.size() - k));
    if (sizes[k] > limit) break;
    left -= std::min(left, sizes[k]);
  }
  Terms out;
  std::vector<std::size_t> taken_rows;
  out.kernel = terms.kernel;
  out.transform = terms.transform;
  out.weighted = terms.weighted;
  out.collapsed = terms.collapsed;
  out.channel.resize(terms.channel.size());
  for (const auto& [cell, rows] : cells) {
    const std::size_t taken = std::min(rows.size(), limit);
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < taken; ++k) chosen.push_back(rows[(2 * k + 1) * rows.size() / (2 * taken)]);
    for (const std::size_t row : chosen) out.geometry.push_back(terms.geometry[row]);
    if (!terms.factor.empty())
      for (const std::size_t row : chosen) out.factor.push_back(terms.factor[row]);
    taken_rows.insert(taken_rows.end(), chosen.begin(), chosen.end());
    for (std::size_t c = 0; c < terms.channel.size(); ++c) {
      const ChannelTerms& all = terms.channel[c];
      ChannelTerms& part = out.channel[c];
      const auto sum = [&](const std::vector<std::size_t>& of) {
        return std::accumulate(of.begin(), of.end(), 0.0, [&](double s, std::size_t row) { return s + all.weight[row]; });
      };
      const double whole = sum(rows), here = sum(chosen), scale = here > 0 ? whole / here : 0;
      for (const std::size_t row : chosen) {
        part.target.push_back(all.target[row]);
        part.weight.push_back(all.weight[row] * scale);
      }
    }
  }
  out.mean = terms.mean.of(taken_rows);
  for (std::size_t c = 0; c < terms.channel.size(); ++c) out.channel[c].within = terms.channel[c].within;
  return out;
}

}  // namespace gonio::fitting
