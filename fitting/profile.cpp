// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/profile.hpp"

#include <algorithm>
#include <cmath>

#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t scan_points = 61;
constexpr double lowest_s = 1e-3, highest_s = 1e9;
constexpr double brent_tolerance = 1e-9;
constexpr std::size_t rows_at_once = 256;    // stays in the first-level cache
constexpr double relative_decrease = 1e-13;  // of the cost: below it the Gauss-Newton steps only shuffle rounding errors
constexpr int most_steps = 60;
/// A rise smaller than this part of the largest cost of the scan is rounding, not a barrier between two minima.
constexpr double ripple = 1e-12;

/// Minimum of `f` on [a, b] (Brent 1973, chapter 5): golden section with parabolic steps where they are trusted.
template <class F>
double brent(F&& f, double a, double b, double tolerance) {
  const double golden = 0.5 * (3 - std::sqrt(5.0));
  double x = a + golden * (b - a), w = x, v = x, fx = f(x), fw = fx, fv = fx, step = 0, before = 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double middle = 0.5 * (a + b), tol = tolerance + 1e-15 * std::abs(x);
    if (std::abs(x - middle) <= 2 * tol - 0.5 * (b - a)) break;
    bool parabola = false;
    if (std::abs(before) > tol) {
      const double r = (x - w) * (fx - fv), q0 = (x - v) * (fx - fw);
      double p = (x - v) * q0 - (x - w) * r, q = 2 * (q0 - r);
      if (q > 0) p = -p;
      q = std::abs(q);
      if (std::abs(p) < std::abs(0.5 * q * before) && p > q * (a - x) && p < q * (b - x)) {
        before = step;
        step = p / q;
        parabola = true;
        if (x + step - a < 2 * tol || b - x - step < 2 * tol) step = std::copysign(tol, middle - x);
      }
    }
    if (!parabola) {
      before = (x < middle ? b : a) - x;
      step = golden * before;
    }
    const double u = x + (std::abs(step) >= tol ? step : std::copysign(tol, step)), fu = f(u);
    if (fu <= fx) {
      (u < x ? b : a) = x;
      v = w, fv = fw, w = x, fw = fx, x = u, fx = fu;
    } else {
      (u < x ? a : b) = u;
      if (fu <= fw || w == x) {
        v = w, fv = fw, w = u, fw = fu;
      } else if (fu <= fv || v == x || v == w) {
        v = u, fv = fu;
      }
    }
  }
  return x;
}

}  // namespace

double Profile::cost_of(std::size_t channel, const std::vector<double>& columns, const std::vector<double>& x) const {
  const ChannelTerms& terms = terms_.channel[channel];
  const std::size_t rows = terms_.rows();
  double cost = terms.within;
  for (std::size_t row = 0; row < rows; ++row) {
    if (!(terms.weight[row] > 0)) continue;
    double f = 0;
    for (std::size_t k = 0; k < x.size(); ++k) f += x[k] * columns[k * rows + row];
    const double residual = terms_.transform.value(f, terms_.geometry[row].cos_i) - terms.target[row];
    cost += terms.weight[row] * residual * residual;
  }
  return std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost;
}

/// The system linearised about f̂ = Σ about_k basis_k, or about the measured values if `about` is null.
ChannelPart Profile::linearised(std::size_t channel, const std::vector<double>& columns, const std::vector<double>* about) const {
  const ChannelTerms& terms = terms_.channel[channel];
  const Transform& transform = terms_.transform;
  const std::size_t rows = terms_.rows(), linear = terms_.kernel.linear;
  double largest = 0;
  if (!transform.linear())
    for (const double target : terms.target) largest = std::max(largest, std::abs(transform.inverse(target, 1)));
  const double floor = 1e-6 * largest;  // keeps the slope of cbrt and log finite where f vanishes
  Triangle triangle(linear + 1);
  Matrix block(rows_at_once, linear + 1);
  for (std::size_t begin = 0; begin < rows; begin += rows_at_once) {
    const std::size_t size = std::min(rows_at_once, rows - begin);
    for (std::size_t j = 0; j < size; ++j) {
      const std::size_t row = begin + j;
      const double cos_i = terms_.geometry[row].cos_i, root = std::sqrt(terms.weight[row]);
      double scale = root, rhs = root * terms.target[row];
      if (!transform.linear() && root > 0) {
        double f = 0;
        if (about)
          for (std::size_t k = 0; k < linear; ++k) f += (*about)[k] * columns[k * rows + row];
        else
          f = transform.inverse(terms.target[row], cos_i);
        const double slope = transform.slope(std::max(f, floor), cos_i);
        scale = root * slope;
        rhs = about ? root * (terms.target[row] - transform.value(f, cos_i) + slope * f) : scale * f;
      }
      for (std::size_t k = 0; k < linear; ++k) block(j, k) = scale * columns[k * rows + row];
      block(j, linear) = rhs;
    }
    triangle.add(block, size);
  }
  const Matrix& r = triangle.r();
  const auto rhs = r.column(linear).first(linear);
  ChannelPart part;
  part.system = {r.top_left(linear, linear), {rhs.begin(), rhs.end()}, held_[channel]};
  part.rest = r(linear, linear) * r(linear, linear) + terms.within;
  const NonNegative solution = solve_non_negative(part.system);
  part.x = solution.x;
  part.cost = solution.square + part.rest;
  return part;
}

ChannelPart Profile::channel_at(std::size_t channel, const std::vector<double>& columns) const {
  ChannelPart part = linearised(channel, columns, nullptr);
  if (terms_.transform.linear()) return part;
  std::vector<double> x = part.x;
  // log needs f̂ > 0 everywhere to start with: no free parameter at zero.
  const std::size_t rows = terms_.rows();
  double mean = 0;
  for (std::size_t row = 0; row < rows; ++row)
    mean += std::max(0.0, terms_.transform.inverse(terms_.channel[channel].target[row], terms_.geometry[row].cos_i)) /
            static_cast<double>(rows);
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::isnan(held_[channel][k])) {
      double column = 0;
      for (std::size_t row = 0; row < rows; ++row) column += columns[k * rows + row] / static_cast<double>(rows);
      if (column > 0) x[k] = std::max(x[k], 1e-3 * mean / column);
    }
  double cost = cost_of(channel, columns, x);
  for (int step = 0; step < most_steps; ++step) {
    part = linearised(channel, columns, &x);
    double taken = 1, next = cost_of(channel, columns, part.x);
    std::vector<double> moved = part.x;
    while (!(next < cost) && taken > 1e-9) {
      taken *= 0.5;
      for (std::size_t k = 0; k < x.size(); ++k) moved[k] = x[k] + taken * (part.x[k] - x[k]);
      next = cost_of(channel, columns, moved);
    }
    if (!(next < cost)) break;
    const double decrease = cost - next;
    x = moved, cost = next;
    if (decrease <= relative_decrease * cost) break;
  }
  part = linearised(channel, columns, &x);
  part.x = x;
  part.cost = cost;
  return part;
}

ProfilePoint Profile::at(double s) const {
  std::vector<double> columns(terms_.kernel.linear * terms_.rows());
  terms_.kernel.basis(terms_.geometry, &s, columns.data(), terms_.rows());
  ProfilePoint point;
  point.s = s;
  for (std::size_t c = 0; c < terms_.channel.size(); ++c) {
    point.channel.push_back(channel_at(c, columns));
    point.cost += point.channel.back().cost;
  }
  return point;
}

std::vector<ProfilePoint> Profile::scan(int threads) const {
  const Parameter& exponent = terms_.kernel.info->parameters[terms_.kernel.linear];
  const double low = std::log(std::max(lowest_s, exponent.lower)), high = std::log(std::min(highest_s, exponent.upper));
  std::vector<ProfilePoint> points(scan_points);
  for_each_index(scan_points, terms_.rows() > 1000 ? threads : 1,
                 [&](std::size_t k) { points[k] = at(std::exp(low + (high - low) * static_cast<double>(k) / (scan_points - 1))); });
  return points;
}

std::vector<Minimum> Profile::minima(const std::vector<ProfilePoint>& scan) const {
  double largest = 0;
  for (const ProfilePoint& point : scan)
    if (std::isfinite(point.cost)) largest = std::max(largest, point.cost);
  const double rise = ripple * largest;
  std::vector<Minimum> found;
  // From the left: a point is the lowest since the last barrier if the cost has risen by more than a ripple before and after it.
  std::size_t lowest = 0;
  bool falling = true;
  double highest = scan[0].cost;
  const auto refine = [&](std::size_t k) {
    Minimum minimum{std::log(scan[k].s), scan[k]};
    const double a = std::log(scan[k == 0 ? 0 : k - 1].s), b = std::log(scan[std::min(k + 1, scan.size() - 1)].s);
    const double x = brent([&](double log_s) { return at(std::exp(log_s)).cost; }, a, b, brent_tolerance);
    const ProfilePoint point = at(std::exp(x));
    if (point.cost < minimum.point.cost - rise * 1e-3 || (point.cost < minimum.point.cost && k > 0 && k + 1 < scan.size()))
      minimum = {x, point};
    found.push_back(std::move(minimum));
  };
  for (std::size_t k = 1; k < scan.size(); ++k) {
    if (falling) {
      if (scan[k].cost < scan[lowest].cost) lowest = k;
      if (scan[k].cost > scan[lowest].cost + rise) {
        refine(lowest);
        falling = false;
        highest = scan[k].cost;
      }
    } else {
      highest = std::max(highest, scan[k].cost);
      if (scan[k].cost < highest - rise) falling = true, lowest = k;
    }
  }
  if (falling) refine(lowest);
  std::sort(found.begin(), found.end(), [](const Minimum& a, const Minimum& b) { return a.point.cost < b.point.cost; });
  return found;
}

}  // namespace gonio::fitting
