// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fitting/row_triangles.hpp"

namespace gonio::fitting {
namespace {

constexpr double relative_decrease = 1e-13;  // of the cost: below it the Gauss-Newton steps only shuffle rounding errors
constexpr int most_steps = 60;

}  // namespace

std::vector<std::vector<double>> ProfilePoint::linear() const {
  std::vector<std::vector<double>> out;
  for (const ChannelPart& part : channel) out.push_back(part.x);
  return out;
}

Profile Profile::holding(std::size_t channel, std::size_t k, double value) const {
  Profile out = *this;
  out.limits_[channel].held[k] = value;
  return out;
}

double Profile::cost_of(std::size_t channel, const std::vector<double>& columns, const std::vector<double>& x) const {
  const ChannelTerms& terms = terms_->channel[channel];
  const std::size_t rows = terms_->rows();
  double cost = terms.within;
  for (std::size_t row = 0; row < rows; ++row) {
    if (!(terms.weight[row] > 0)) continue;
    double f = 0;
    for (std::size_t k = 0; k < x.size(); ++k) f += x[k] * columns[k * rows + row];
    const double residual = terms_->transform.value(f, terms_->geometry[row].cos_i) - terms.target[row];
    cost += terms.weight[row] * residual * residual;
  }
  return std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost;
}

ChannelPart Profile::channel_part(std::size_t channel, const Matrix& r) const {
  const std::size_t linear = terms_->kernel.linear;
  const auto rhs = r.column(linear).first(linear);
  const LinearLimits& limits = limits_[channel];
  ChannelPart part;
  part.system = {r.top_left(linear, linear), {rhs.begin(), rhs.end()}, limits.held, limits.lower, limits.upper};
  part.rest = r(linear, linear) * r(linear, linear) + terms_->channel[channel].within;
  Bounded solution = solve_bounded(part.system);
  part.x = std::move(solution.x);
  part.cost = solution.square + part.rest;
  return part;
}

/// The system linearised about f̂ = Σ about_k basis_k, or about the measured values if `about` is null.
ChannelPart Profile::linearised(std::size_t channel, const std::vector<double>& columns, const std::vector<double>* about,
                                int threads) const {
  const ChannelTerms& terms = terms_->channel[channel];
  const Transform& transform = terms_->transform;
  const std::size_t rows = terms_->rows(), linear = terms_->kernel.linear;
  double largest = 0;
  for (const double target : terms.target) largest = std::max(largest, std::abs(transform.inverse(target, 1)));
  const double floor = 1e-6 * largest;  // keeps the slope of cbrt and log finite where f vanishes
  const auto triangles =
      triangles_of_rows(rows, {linear + 1}, threads, [&](std::size_t begin, std::size_t end, std::vector<Matrix>& blocks) {
        Matrix& block = blocks.front();
        for (std::size_t row = begin; row < end; ++row) {
          const std::size_t j = row - begin;
          const double cos_i = terms_->geometry[row].cos_i, root = std::sqrt(terms.weight[row]);
          double scale = root, rhs = root * terms.target[row];
          if (root > 0) {
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
      });
  return channel_part(channel, triangles.front().r());
}

ChannelPart Profile::channel_at(std::size_t channel, const std::vector<double>& columns, int threads) const {
  ChannelPart part = linearised(channel, columns, nullptr, threads);
  std::vector<double> x = part.x;
  // log needs f̂ > 0 everywhere to start with: no free parameter at zero.
  const std::size_t rows = terms_->rows();
  double mean = 0;
  for (std::size_t row = 0; row < rows; ++row)
    mean += std::max(0.0, terms_->transform.inverse(terms_->channel[channel].target[row], terms_->geometry[row].cos_i)) /
            static_cast<double>(rows);
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::isnan(limits_[channel].held[k])) {
      double column = 0;
      for (std::size_t row = 0; row < rows; ++row) column += columns[k * rows + row] / static_cast<double>(rows);
      if (column > 0) x[k] = std::min(std::max(x[k], 1e-3 * mean / column), part.system.high(k));
    }
  double cost = cost_of(channel, columns, x);
  for (int step = 0; step < most_steps; ++step) {
    part = linearised(channel, columns, &x, threads);
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
  part = linearised(channel, columns, &x, threads);
  part.x = x;
  part.cost = cost;
  return part;
}

/// [basis | f] of all rows, one triangle per channel.
std::vector<Matrix> Profile::triangles(std::span<const double> theta, int threads) const {
  if (terms_->sums) return terms_->sums->triangles(theta.front(), threads);
  const std::size_t linear = terms_->kernel.linear, channels = terms_->channel.size();
  const auto fill = [&](std::size_t begin, std::size_t end, std::vector<Matrix>& blocks) {
    const std::size_t size = end - begin;
    std::array<double, max_linear * rows_at_once> columns;
    terms_->basis(begin, end, theta.data(), columns.data(), rows_at_once);
    for (std::size_t c = 0; c < channels; ++c) {
      const ChannelTerms& terms = terms_->channel[c];
      std::array<double, rows_at_once> root;
      for (std::size_t j = 0; j < size; ++j) root[j] = std::sqrt(terms.weight[begin + j]);
      for (std::size_t k = 0; k < linear; ++k) {
        const auto column = blocks[c].column(k);
        for (std::size_t j = 0; j < size; ++j) column[j] = root[j] * columns[k * rows_at_once + j];
      }
      const auto rhs = blocks[c].column(linear);
      for (std::size_t j = 0; j < size; ++j) rhs[j] = root[j] * terms.target[begin + j];
    }
  };
  std::vector<Matrix> out;
  for (const Triangle& triangle : triangles_of_rows(terms_->rows(), std::vector<std::size_t>(channels, linear + 1), threads, fill))
    out.push_back(triangle.r());
  return out;
}

void Profile::prepare(const SearchSpace& space, double low, double high, int threads) {
  const SearchAxis& axis = space.axes().front();
  const auto node = [&](double place) {
    std::vector<double> theta = space.theta(std::span(&place, 1));
    if (terms_->sums) theta.front() = terms_->sums->nearest(theta.front());
    return InterpolatedTriangles::Node{axis.coordinate(theta[axis.parameter]), triangles(theta, 1)};
  };
  stretch_ = std::make_shared<const Stretch>(Stretch{axis, InterpolatedTriangles(low, high, threads, node)});
}

ProfilePoint Profile::from_triangles(std::span<const double> theta, const std::vector<Matrix>& triangles) const {
  ProfilePoint point;
  point.theta.assign(theta.begin(), theta.end());
  for (std::size_t c = 0; c < triangles.size(); ++c) {
    point.channel.push_back(channel_part(c, triangles[c]));
    point.cost += point.channel.back().cost;
  }
  return point;
}

ProfilePoint Profile::at(std::span<const double> theta, int threads) const {
  if (stretch_)
    if (const double place = stretch_->axis.coordinate(theta[stretch_->axis.parameter]); stretch_->triangles.covers(place))
      return from_triangles(theta, stretch_->triangles.at(place));
  return at_rows(theta, threads);
}

ProfilePoint Profile::at_rows(std::span<const double> theta, int threads) const {
  if (terms_->sums || terms_->transform.linear()) return from_triangles(theta, triangles(theta, threads));
  const std::size_t rows = terms_->rows();
  ProfilePoint point;
  point.theta.assign(theta.begin(), theta.end());
  std::vector<double> columns(terms_->kernel.linear * rows);
  terms_->basis(0, rows, theta.data(), columns.data(), rows);
  for (std::size_t c = 0; c < terms_->channel.size(); ++c) {
    point.channel.push_back(channel_at(c, columns, threads));
    point.cost += point.channel.back().cost;
  }
  return point;
}

}  // namespace gonio::fitting
