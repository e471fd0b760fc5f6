// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/point_fit.hpp"

#include <cmath>

#include "fitting/thinned.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t rows_for_search = 4096;
constexpr std::size_t rows_at_once = 1024;

}  // namespace

PointFit::PointFit(const Terms& terms, const SolveOptions& options)
    : terms_(terms), options_(options), space_(terms.kernel, options.nonlinear, options.alike) {}

std::optional<std::vector<std::vector<double>>> PointFit::operator()(bool global) {
  const Profile profile(terms_, options_.limits);
  DescentOptions descent;
  descent.threads = options_.threads;
  if (!last_ || global) {
    const Terms few = thinned(terms_, rows_for_search);
    const Found found = search_globally(Profile(few, options_.limits), space_, options_.threads);
    if (found.minima.empty() || !std::isfinite(found.minima.front().point.cost)) return std::nullopt;
    last_ = found.minima.front();
  }
  last_ =
      space_.dimension() == 0 ? Minimum{{}, profile.at(space_.theta({}), options_.threads)} : descend(profile, space_, last_->z, descent);
  if (!std::isfinite(last_->point.cost)) return std::nullopt;
  return fitted_values(terms_, last_->point.linear(), last_->point.theta);
}

std::vector<std::vector<double>> fitted_values(const Terms& terms, const std::vector<std::vector<double>>& linear,
                                               const std::vector<double>& theta) {
  const std::size_t rows = terms.rows(), count = terms.kernel.linear;
  std::vector<std::vector<double>> out(linear.size(), std::vector<double>(rows, 0.0));
  std::vector<double> columns(count * rows_at_once);
  for (std::size_t begin = 0; begin < rows; begin += rows_at_once) {
    const std::size_t end = std::min(rows, begin + rows_at_once);
    terms.basis(begin, end, theta.data(), columns.data(), rows_at_once);
    for (std::size_t c = 0; c < out.size(); ++c)
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t row = begin; row < end; ++row) out[c][row] += linear[c][k] * columns[k * rows_at_once + row - begin];
  }
  return out;
}

}  // namespace gonio::fitting
