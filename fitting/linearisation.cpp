// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/linearisation.hpp"

#include <algorithm>
#include <cmath>

#include "fitting/row_triangles.hpp"

namespace gonio::fitting {

void Linearisation::reduced(std::vector<double>& normal, std::vector<double>& gradient) const {
  normal.assign(free * free, 0.0);
  gradient.assign(free, 0.0);
  for (std::size_t c = 0; c < r.size(); ++c) {
    const std::size_t n = columns[c].size();
    for (std::size_t row = n; row < n + free; ++row)
      for (std::size_t i = 0; i < free; ++i) {
        gradient[i] += r[c](row, n + i) * r[c](row, n + free);
        for (std::size_t j = 0; j < free; ++j) normal[i * free + j] += r[c](row, n + i) * r[c](row, n + j);
      }
  }
}

Linearisation linearise(const Terms& terms, const SearchSpace& space, const std::vector<LinearLimits>& limits,
                        const std::vector<std::vector<double>>& linear, std::span<const double> theta, std::span<const Change> changes,
                        int threads) {
  Linearisation out;
  out.free = space.dimension();
  out.right = std::max<std::size_t>(1, changes.size());
  const std::size_t count = terms.kernel.linear, channels = terms.channel.size();
  std::vector<std::size_t> sizes;
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<std::size_t> columns;
    for (std::size_t k = 0; k < count; ++k) {
      const double low = limits[c].lower.empty() ? 0 : limits[c].lower[k];
      const bool below = limits[c].upper.empty() || linear[c][k] < limits[c].upper[k];
      if (std::isnan(limits[c].held[k]) && linear[c][k] > low && below) columns.push_back(k);
    }
    sizes.push_back(columns.size() + out.free + out.right);
    out.columns.push_back(std::move(columns));
  }
  const auto fill = [&](std::size_t begin, std::size_t end, std::vector<Matrix>& blocks) {
    std::vector<double> basis(count * rows_at_once), slopes(terms.kernel.nonlinear * count * rows_at_once), by_theta(out.free);
    terms.basis_and_slopes(begin, end, theta.data(), basis.data(), slopes.data(), rows_at_once);
    for (std::size_t c = 0; c < channels; ++c) {
      const ChannelTerms& data = terms.channel[c];
      Matrix& block = blocks[c];
      const std::size_t n = out.columns[c].size();
      for (std::size_t row = begin; row < end; ++row) {
        const std::size_t j = row - begin;
        const double root = std::sqrt(data.weight[row]), cos_i = terms.geometry[row].cos_i;
        double f = 0;
        for (std::size_t k = 0; k < count; ++k) f += linear[c][k] * basis[k * rows_at_once + j];
        const double slope = root > 0 && (terms.transform.linear() || f > 0) ? root * terms.transform.slope(f, cos_i) : 0;
        for (std::size_t k = 0; k < n; ++k) block(j, k) = slope * basis[out.columns[c][k] * rows_at_once + j];
        for (std::size_t a = 0; a < out.free; ++a) {
          const std::size_t first = space.axes()[a].parameter * count;
          double by = 0;
          for (std::size_t k = 0; k < count; ++k) by += linear[c][k] * slopes[(first + k) * rows_at_once + j];
          block(j, n + a) = slope * by;
        }
        const std::size_t first = n + out.free;
        const auto finite = [](double y) { return std::isfinite(y) ? y : 0; };
        if (changes.empty()) block(j, first) = root > 0 ? finite(root * (terms.transform.value(f, cos_i) - data.target[row])) : 0;
        for (std::size_t k = 0; k < changes.size(); ++k) block(j, first + k) = root > 0 ? finite(root * changes[k](c, row, f)) : 0;
      }
    }
  };
  for (const Triangle& triangle : triangles_of_rows(terms.rows(), sizes, threads, fill)) out.r.push_back(triangle.r());
  return out;
}

}  // namespace gonio::fitting
