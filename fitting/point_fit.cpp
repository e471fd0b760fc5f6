// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/point_fit.hpp"

#include <cmath>

#include "fitting/thinned.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t rows_for_search = 2048;
constexpr double coarse = 1e-4;   // on the axis: a part of the rows says no more
constexpr double settled = 1e-6;  // decrease of the cost in variances of one reading: a thousandth of a standard deviation
constexpr std::size_t rows_at_once = 1024;

}  // namespace

PointFit::PointFit(const Terms& terms, const SolveOptions& options)
    : terms_(terms), options_(options), space_(terms.kernel, options.nonlinear, options.alike) {}

std::optional<std::vector<std::vector<double>>> PointFit::operator()(bool global) {
  const Profile profile(terms_, options_.limits);
  const bool search = global || minima_.empty();
  if (search) {
    const Terms few = thinned(terms_, rows_for_search);
    Profile of_few(few, options_.limits);
    const bool part = few.rows() < terms_.rows();
    minima_ = part && space_.dimension() == 1 ? search_axis(of_few, space_, options_.threads, coarse).minima
                                              : search_globally(of_few, space_, options_.threads).minima;
    if (minima_.empty()) return std::nullopt;
  } else if (space_.dimension() > 0) {
    DescentOptions descent;
    descent.threads = options_.threads;
    descent.tolerance = settled * minima_.front().point.cost / static_cast<double>(terms_.rows());
    minima_.front() = descend(profile, space_, minima_.front().z, descent);
  }
  Minimum& last = minima_.front();
  if (search || space_.dimension() == 0) last.point = profile.at(last.point.theta, options_.threads);
  if (!std::isfinite(last.point.cost)) return minima_.clear(), std::nullopt;
  return fitted_values(terms_, last.point.linear(), last.point.theta);
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
