// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/joint_intervals.hpp"

#include <algorithm>
#include <cmath>

#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t many_rows = 16384;  // have threads of their own
constexpr double end_tolerance = 1e-3;    // of √budget: a thousandth of the half width
constexpr double path_tolerance = 1e-4;   // of the budget: how well the others are minimised along the path
constexpr double first_part = 0.02;       // of an axis, or of a value: the first step where there is no covariance
constexpr double most_growth = 4;         // of a step outwards
constexpr double most_slope = 0.01;       // of the budget per unit of an axis, at an end of the search
constexpr int most_steps = 60;
constexpr int steps_on_path = 15;  // of a descent that starts where the path leads

/// A parameter and the least cost for each of its values.
class Path {
 public:
  Path(const Profile& profile, const SearchSpace& space, const ParameterPlaces& places, const Matrix& covariance, std::size_t parameter)
      : profile_(profile), space_(space), places_(places), covariance_(covariance), parameter_(parameter) {
    if (parameter >= places.of_nonlinear(0))
      for (std::size_t a = 0; a < space.dimension(); ++a)
        if (places.of_nonlinear(space.axes()[a].parameter) == parameter) axis_ = a;
  }
  double value(const Minimum& at) const {
    return axis_ ? at.z[*axis_] : at.point.channel[parameter_ / places_.linear].x[parameter_ % places_.linear];
  }
  Minimum at(double value, std::vector<double> z, double tolerance, int threads) const {
    DescentOptions options{axis_, tolerance, steps_on_path, threads};
    if (axis_) z[*axis_] = value;
    Minimum found = axis_ ? descend(profile_, space_, z, options) : descend(holding(value), space_, z, options);
    // Beyond the order of equal terms the same set lies once more.
    if (!space_.ordered(found.point.theta)) found.point.cost = infinity;
    return found;
  }
  /// Whether the cost there would fall further if the search did not end: then it is the search that limits the parameter, not the data.
  bool limited_by_search(double value, const Minimum& at, double budget, int threads) const {
    std::vector<double> normal, gradient;
    linearise(profile_.terms(), space_, axis_ ? profile_.limits() : holding(value).limits(), at.point.linear(), at.point.theta, {}, threads)
        .reduced(normal, gradient);
    for (std::size_t a = 0; a < gradient.size(); ++a) {
      const SearchAxis& axis = space_.axes()[a];
      const double slope = 2 * gradient[a] * axis.slope(at.point.theta[axis.parameter]);
      if (axis_ == a) continue;
      if ((at.z[a] <= axis.low && slope > most_slope * budget) || (at.z[a] >= axis.high && -slope > most_slope * budget)) return true;
    }
    return false;
  }
  double low_limit() const {
    if (axis_) return space_.axes()[*axis_].low;
    const LinearLimits& limits = profile_.limits()[parameter_ / places_.linear];
    return limits.lower.empty() ? 0 : limits.lower[parameter_ % places_.linear];
  }
  double high_limit() const {
    if (axis_) return space_.axes()[*axis_].high;
    const std::size_t k = parameter_ % places_.linear;
    const LinearLimits& limits = profile_.limits()[parameter_ / places_.linear];
    const double most = profile_.terms().kernel.info->parameters[k].upper;
    return limits.upper.empty() ? most : std::min(most, limits.upper[k]);
  }
  /// The standard uncertainty on the axis, NaN without covariance.
  double sigma(const std::vector<double>& theta) const { return std::sqrt(covariance_(parameter_, parameter_)) / slope(parameter_, theta); }
  double first_step(double value) const {
    return axis_ ? first_part * (space_.axes()[*axis_].scan_high - space_.axes()[*axis_].scan_low) : first_part * std::max(value, 1e-6);
  }
  /// How the axes move with the parameter, from the covariance; 0 where there is none.
  std::vector<double> direction(const std::vector<double>& theta) const {
    std::vector<double> out;
    for (const SearchAxis& axis : space_.axes()) {
      const std::size_t other = places_.of_nonlinear(axis.parameter);
      const double part =
          covariance_(other, parameter_) / covariance_(parameter_, parameter_) * slope(parameter_, theta) / slope(other, theta);
      out.push_back(std::isfinite(part) ? part : 0);
    }
    return out;
  }
  const SearchSpace& space() const { return space_; }

 private:
  Profile holding(double value) const { return profile_.holding(parameter_ / places_.linear, parameter_ % places_.linear, value); }
  double slope(std::size_t parameter, const std::vector<double>& theta) const {
    for (const SearchAxis& axis : space_.axes())
      if (places_.of_nonlinear(axis.parameter) == parameter) return axis.slope(theta[axis.parameter]);
    return 1;
  }
  const Profile& profile_;
  const SearchSpace& space_;
  const ParameterPlaces& places_;
  const Matrix& covariance_;
  std::size_t parameter_;
  std::optional<std::size_t> axis_;
};

struct Budget {
  double least, size, quantile;

  /// Below 0 inside the set.
  double excess(double cost) const { return std::sqrt(std::max(0.0, cost - least)) - std::sqrt(size); }
};

std::vector<double> moved(const SearchSpace& space, const std::vector<double>& from, const std::vector<double>& direction, double by) {
  std::vector<double> z = from;
  for (std::size_t a = 0; a < z.size(); ++a) z[a] = std::clamp(from[a] + by * direction[a], space.axes()[a].low, space.axes()[a].high);
  return z;
}

/// The end of the set on one side (±1) of a start inside it.
double end_of(const Path& path, const Minimum& start, const Budget& budget, double side, int threads) {
  const double limit = side < 0 ? path.low_limit() : path.high_limit();
  const double open = side * infinity, tolerance = path_tolerance * budget.size;
  struct Point {
    double value, excess;
    std::vector<double> z;
  };
  Point inside{path.value(start), budget.excess(start.point.cost), start.z};
  if (!(inside.excess < 0) || side * (limit - inside.value) <= 0) return side * (limit - inside.value) <= 0 ? open : inside.value;
  const Point origin = inside;
  std::vector<double> direction = path.direction(start.point.theta);
  const double sigma = path.sigma(start.point.theta);
  double step = std::isfinite(sigma) && sigma > 0 ? budget.quantile * sigma : path.first_step(inside.value);
  std::optional<Point> outside;
  for (int k = 0; k < most_steps && !outside; ++k) {
    double next = inside.value + side * step;
    const bool at_limit = side * (next - limit) >= 0;
    if (at_limit) next = limit;
    const Minimum found = path.at(next, moved(path.space(), inside.z, direction, next - inside.value), tolerance, threads);
    Point point{next, budget.excess(found.point.cost), found.z};
    if (std::abs(point.excess) <= end_tolerance * std::sqrt(budget.size) && !at_limit)
      return path.limited_by_search(next, found, budget.size, threads) ? open : next;
    if (point.excess > 0) {
      outside = std::move(point);
      break;
    }
    if (at_limit) return open;
    // Outwards as far as the straight line through the start says, and the path goes on as it went.
    const double gained = point.excess - origin.excess, gone = next - origin.value;
    const double wanted = gained > 0 ? std::abs(gone * -origin.excess / gained - gone) * 1.02 : infinity;
    for (std::size_t a = 0; a < direction.size(); ++a) direction[a] = (point.z[a] - inside.z[a]) / (next - inside.value);
    step = std::clamp(wanted, 0.1 * step, most_growth * std::abs(gone));
    inside = std::move(point);
  }
  if (!outside) return open;
  double weight = 1;  // of the outer excess: halved when the same side moves twice (Illinois)
  bool moved_inside = false;
  for (int k = 0; k < most_steps; ++k) {
    const double width = outside->value - inside.value, outer = weight * outside->excess;
    double part = std::isfinite(outer) ? -inside.excess / (outer - inside.excess) : 0.5;
    part = std::clamp(part, 0.01, 0.99);
    const double next = inside.value + part * width;
    std::vector<double> z = inside.z;
    for (std::size_t a = 0; a < z.size(); ++a) z[a] += part * (outside->z[a] - inside.z[a]);
    const Minimum found = path.at(next, z, tolerance, threads);
    Point point{next, budget.excess(found.point.cost), found.z};
    if (std::abs(point.excess) <= end_tolerance * std::sqrt(budget.size) || std::abs(width) <= 1e-9 * (1e-3 + std::abs(next)))
      return path.limited_by_search(next, found, budget.size, threads) ? open : next;
    if (point.excess < 0) {
      weight = moved_inside ? weight * 0.5 : 1;
      moved_inside = true;
      inside = std::move(point);
    } else {
      weight = 1;
      moved_inside = false;
      outside = std::move(point);
    }
  }
  return outside->value;
}

}  // namespace

std::vector<Reach> joint_reach(const Profile& profile, const SearchSpace& space, const std::vector<Minimum>& minima,
                               const ParameterPlaces& places, std::span<const std::size_t> asked, const Matrix& covariance, double least,
                               double budget, double quantile, int threads) {
  std::vector<Reach> out(places.size());
  const bool split = profile.terms().rows() <= many_rows;
  const Budget limit{least, budget, quantile};
  for_each_index(2 * asked.size(), split ? threads : 1, [&](std::size_t task) {
    const std::size_t parameter = asked[task / 2];
    const double side = task % 2 == 0 ? -1 : 1;
    const Path path(profile, space, places, covariance, parameter);
    const Minimum* start = &minima.front();
    for (const Minimum& minimum : minima)
      if (minimum.point.cost <= least + budget && side * (path.value(minimum) - path.value(*start)) > 0) start = &minimum;
    const double end = end_of(path, *start, limit, side, split ? 1 : threads);
    (side < 0 ? out[parameter].low : out[parameter].high) = end;
  });
  return out;
}

}  // namespace gonio::fitting
