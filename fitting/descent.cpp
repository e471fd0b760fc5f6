// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/descent.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "fitting/linearisation.hpp"

namespace gonio::fitting {
namespace {

constexpr double first_damping = 1e-4, least_damping = 1e-12, most_damping = 1e12;
constexpr double longest_step = 0.15;        // of an axis: beyond it the linearisation is no guide
constexpr double relative_decrease = 1e-14;  // of the cost: rounding
constexpr double shortest_step = 1e-11;      // on an axis

/// Normal equations on the axes of the search; an axis that is held, or at an end the gradient points out of, is left out.
struct Step {
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  std::vector<std::size_t> moving;
};

Step step_at(const Profile& profile, const SearchSpace& space, const Minimum& at, const DescentOptions& options) {
  const Linearisation linearised =
      linearise(profile.terms(), space, profile.limits(), at.point.linear(), at.point.theta, {}, options.threads);
  std::vector<double> normal, gradient;
  linearised.reduced(normal, gradient);
  const std::size_t d = space.dimension();
  Step out;
  for (std::size_t a = 0; a < d; ++a) {
    const SearchAxis& axis = space.axes()[a];
    const bool out_of_low = at.z[a] <= axis.low && gradient[a] > 0, out_of_high = at.z[a] >= axis.high && gradient[a] < 0;
    if (options.hold == a || out_of_low || out_of_high || !(normal[a * d + a] > 0)) continue;
    out.moving.push_back(a);
  }
  const auto n = static_cast<Eigen::Index>(out.moving.size());
  out.normal.resize(n, n);
  out.gradient.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t a = out.moving[static_cast<std::size_t>(i)];
    const double scale_a = space.axes()[a].slope(at.point.theta[space.axes()[a].parameter]);
    out.gradient[i] = gradient[a] * scale_a;
    for (Eigen::Index j = 0; j < n; ++j) {
      const std::size_t b = out.moving[static_cast<std::size_t>(j)];
      out.normal(i, j) = normal[a * d + b] * scale_a * space.axes()[b].slope(at.point.theta[space.axes()[b].parameter]);
    }
  }
  return out;
}

struct Trial {
  std::vector<double> z;
  double longest = 0;  ///< move on any axis
  double promise = 0;  ///< decrease of the cost if the residuals were linear
};

Trial trial_step(const SearchSpace& space, const Minimum& at, const Step& step, double damping) {
  Eigen::MatrixXd damped = step.normal;
  damped.diagonal() *= 1 + damping;
  Eigen::VectorXd change = -damped.ldlt().solve(step.gradient);
  double shorten = 1;
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const SearchAxis& axis = space.axes()[step.moving[static_cast<std::size_t>(i)]];
    if (!std::isfinite(change[i])) change[i] = 0;
    const double longest = longest_step * (axis.scan_high - axis.scan_low);
    if (std::abs(change[i]) > longest) shorten = std::min(shorten, longest / std::abs(change[i]));
  }
  Trial trial{at.z, 0, 0};
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const std::size_t a = step.moving[static_cast<std::size_t>(i)];
    const SearchAxis& axis = space.axes()[a];
    trial.z[a] = std::clamp(at.z[a] + shorten * change[i], axis.low, axis.high);
    change[i] = trial.z[a] - at.z[a];
    trial.longest = std::max(trial.longest, std::abs(change[i]));
  }
  trial.promise = -(2 * step.gradient.dot(change) + change.dot(step.normal * change));
  return trial;
}

}  // namespace

Minimum descend(const Profile& profile, const SearchSpace& space, std::span<const double> start, const DescentOptions& options) {
  Minimum at;
  at.z.assign(start.begin(), start.end());
  at.point = profile.at(space.theta(at.z), options.threads);
  double damping = first_damping;
  bool done = space.dimension() == (options.hold ? 1 : 0);
  for (int iteration = 0; iteration < options.most_steps && !done && std::isfinite(at.point.cost); ++iteration) {
    const Step step = step_at(profile, space, at, options);
    if (step.moving.empty()) break;
    // What the undamped step promises; the last step is still taken if it helps.
    const double promise = step.gradient.dot(step.normal.ldlt().solve(step.gradient));
    done = !(promise > std::max(options.tolerance, relative_decrease * at.point.cost));
    for (;;) {
      const Trial trial = trial_step(space, at, step, damping);
      done = done || trial.longest < shortest_step;
      ProfilePoint point = profile.at(space.theta(trial.z), options.threads);
      if (point.cost < at.point.cost) {
        const double gain = (at.point.cost - point.cost) / trial.promise;
        at.z = trial.z, at.point = std::move(point);
        damping = std::max(least_damping, gain > 0.75 ? damping * 0.1 : gain < 0.25 ? damping * 4 : damping);
        break;
      }
      damping = std::max(damping, first_damping) * 8;
      done = done || damping > most_damping;
      if (done) break;
    }
  }
  return at;
}

}  // namespace gonio::fitting
