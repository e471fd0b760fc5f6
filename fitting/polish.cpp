// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/polish.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace gonio::fitting {
namespace {

constexpr std::size_t rows_at_once = 512;
constexpr std::size_t rows_for_qr = 200000;

class Rows final : public ceres::CostFunction {
 public:
  Rows(const Terms& terms, std::size_t channel, std::size_t begin, std::size_t end)
      : terms_(terms), channel_(channel), begin_(begin), end_(end) {
    set_num_residuals(static_cast<int>(end - begin));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(terms.kernel.linear));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(std::max<std::size_t>(terms.kernel.nonlinear, 1)));
  }
  bool Evaluate(double const* const* parameters, double* out, double** jacobians) const override {
    return residuals(terms_, channel_, begin_, end_, parameters[0], parameters[1], out, jacobians ? jacobians[0] : nullptr,
                     jacobians ? jacobians[1] : nullptr);
  }

 private:
  const Terms& terms_;
  std::size_t channel_, begin_, end_;
};

}  // namespace

bool residuals(const Terms& terms, std::size_t channel, std::size_t begin, std::size_t end, const double* linear, const double* theta,
               double* out, double* by_linear, double* by_theta) {
  const std::size_t rows = end - begin, count = terms.kernel.linear, nonlinear = terms.kernel.nonlinear;
  std::vector<double> columns(count * rows), slopes(nonlinear * count * rows);
  if (by_theta)
    terms.basis_and_slopes(begin, end, theta, columns.data(), slopes.data(), rows);
  else
    terms.basis(begin, end, theta, columns.data(), rows);
  const ChannelTerms& data = terms.channel[channel];
  for (std::size_t j = 0; j < rows; ++j) {
    const std::size_t row = begin + j;
    const double root = std::sqrt(data.weight[row]), cos_i = terms.geometry[row].cos_i;
    double f = 0;
    for (std::size_t k = 0; k < count; ++k) f += linear[k] * columns[k * rows + j];
    const bool used = root > 0;
    const double phi = used ? terms.transform.value(f, cos_i) : 0;
    if (!std::isfinite(phi)) return false;
    const double slope = used ? root * std::min(terms.transform.slope(f, cos_i), 1e150) : 0;  // cbrt: infinite at f = 0
    out[j] = used ? root * (phi - data.target[row]) : 0;
    if (by_linear)
      for (std::size_t k = 0; k < count; ++k) by_linear[j * count + k] = slope * columns[k * rows + j];
    if (by_theta)
      for (std::size_t i = 0; i < nonlinear; ++i) {
        double f_by_theta = 0;
        for (std::size_t k = 0; k < count; ++k) f_by_theta += linear[k] * slopes[(i * count + k) * rows + j];
        by_theta[j * nonlinear + i] = slope * f_by_theta;
      }
  }
  return true;
}

Polished polish(const Terms& terms, const SearchSpace& space, const std::vector<LinearLimits>& limits,
                const std::vector<std::vector<double>>& start, const std::vector<double>& theta, int threads, int most_iterations,
                double function_tolerance) {
  Polished result{start, theta, 0, false, {}};
  ceres::Problem problem;
  std::vector<double> nonlinear = theta;
  if (nonlinear.empty()) nonlinear.push_back(0);  // a block must not be empty
  std::vector<std::vector<double>> linear = start;
  const auto keep = [&](std::vector<double>& block, const std::vector<int>& constant) {
    if (constant.size() == block.size())
      problem.SetParameterBlockConstant(block.data());
    else if (!constant.empty())
      problem.SetManifold(block.data(), new ceres::SubsetManifold(static_cast<int>(block.size()), constant));
  };
  for (std::size_t c = 0; c < terms.channel.size(); ++c) {
    for (std::size_t begin = 0; begin < terms.rows(); begin += rows_at_once)
      problem.AddResidualBlock(new Rows(terms, c, begin, std::min(begin + rows_at_once, terms.rows())), nullptr, linear[c].data(),
                               nonlinear.data());
    std::vector<int> constant;
    for (std::size_t k = 0; k < terms.kernel.linear; ++k) {
      const int at = static_cast<int>(k);
      problem.SetParameterLowerBound(linear[c].data(), at, limits[c].lower.empty() ? 0 : limits[c].lower[k]);
      if (!limits[c].upper.empty() && std::isfinite(limits[c].upper[k]))
        problem.SetParameterUpperBound(linear[c].data(), at, limits[c].upper[k]);
      if (!std::isnan(limits[c].held[k])) constant.push_back(at);
    }
    keep(linear[c], constant);
  }
  std::vector<int> constant;
  for (std::size_t j = 0; j < nonlinear.size(); ++j) constant.push_back(static_cast<int>(j));
  for (const SearchAxis& axis : space.axes()) {
    const int at = static_cast<int>(axis.parameter);
    std::erase(constant, at);
    problem.SetParameterLowerBound(nonlinear.data(), at, axis.value(axis.low));
    problem.SetParameterUpperBound(nonlinear.data(), at, axis.value(axis.high));
  }
  keep(nonlinear, constant);
  ceres::Solver::Options options;
  // QR squares no condition number; a large table would need a gigabyte for it.
  options.linear_solver_type = terms.rows() * terms.channel.size() <= rows_for_qr ? ceres::DENSE_QR : ceres::DENSE_NORMAL_CHOLESKY;
  options.num_threads = threads;
  options.max_num_iterations = most_iterations;
  options.function_tolerance = function_tolerance;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-16;
  options.logging_type = ceres::SILENT;
  FLAGS_minloglevel = google::GLOG_FATAL;  // a library does not print; what Ceres has to say stands in the summary
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  double constants = 0;
  for (const ChannelTerms& channel : terms.channel) constants += channel.within;
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.cost = 2 * (result.converged ? summary.final_cost : summary.initial_cost) + constants;
  if (!result.converged) {
    result.reason = summary.message;
    return result;
  }
  result.linear = linear;
  result.theta.assign(nonlinear.begin(), nonlinear.begin() + static_cast<std::ptrdiff_t>(theta.size()));
  return result;
}

}  // namespace gonio::fitting
