// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/row_weights.hpp"

#include <algorithm>
#include <cmath>

namespace gonio::fitting {
namespace {

constexpr double rounding = 1e-12;    // of the largest value: exact data have at least this standard deviation
constexpr double row_prior_dof = 10;  // a row's own scatter counts against the model of all rows like this many readings

}  // namespace

std::vector<VarianceModel> weigh_rows(Terms& terms) {
  std::vector<VarianceModel> models;
  for (ChannelTerms& channel : terms.channel) {
    DeviationCells cells;
    double largest = 0;
    for (std::size_t row = 0; row < terms.rows(); ++row) {
      const double n = static_cast<double>(channel.row_count[row]);
      largest = std::max(largest, std::abs(channel.target[row]));
      if (n > 1) cells.add(channel.target[row], 0, channel.row_within[row] / (n - 1), n - 1);
    }
    const VarianceModel model = variance_model(cells);
    const double floor = rounding * rounding * largest * largest;
    channel.within = channel.weighted_value2 = 0;
    for (std::size_t row = 0; row < terms.rows(); ++row) {
      const double n = static_cast<double>(channel.row_count[row]);
      if (!(n > 0)) continue;
      const double variance =
          std::max((channel.row_within[row] + row_prior_dof * model(channel.target[row], 0)) / (n - 1 + row_prior_dof), floor);
      // The inverse of an estimated variance is too large on average by the variance of its ratio to the true one.
      const double excess = 2 * (n - 1) / ((n - 1 + row_prior_dof) * (n - 1 + row_prior_dof));
      channel.weight[row] = variance > 0 ? n / (variance * (1 + excess)) : 0;
      channel.within += variance > 0 ? channel.row_within[row] / variance : 0;
      channel.weighted_value2 += channel.weight[row] * channel.target[row] * channel.target[row];
    }
    models.push_back(model);
  }
  return models;
}

}  // namespace gonio::fitting
