// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/variance_model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "fitting/distributions.hpp"
#include "fitting/linear_part.hpp"

namespace gonio::fitting {
namespace {

constexpr int lowest_octave = -40, octaves = 80;  // 1e-12 … 1e12 1/sr
constexpr int per_octave = 4;
constexpr std::size_t incidence_classes = 4;
constexpr double least_cosine = 1e-3;             // of the incidence, 89.94°: beyond it the tangent says nothing of the noise any more
constexpr double enough_dof = 30;                 // below it a constant variance is all that can be told
constexpr unsigned gain_part = 4, tilt_part = 8;  // of a set of parts; tilt grows with f like gain and is looked for beside it
constexpr int most_steps = 50;
constexpr double settled = 1e-7;     // of the likelihood per degree of freedom
constexpr double least_part = 1e-9;  // of the largest variance: keeps the weights of perfectly repeated cells finite

/// The cell of 0 too is the lowest; f is not negative.
std::size_t cell_of(double f, double tan2_i) noexcept {
  // The exponent and the first two bits of the mantissa count quarters of octaves.
  constexpr std::int64_t lowest = std::int64_t{1023 + lowest_octave} * per_octave, most = octaves * per_octave - 1;
  const std::int64_t quarter = std::bit_cast<std::int64_t>(f) >> 50;
  // Cosines of the incidence below 1/4, 1/2 and 3/4.
  const std::size_t incidence = std::size_t{tan2_i <= 15} + std::size_t{tan2_i <= 3} + std::size_t{tan2_i <= 7.0 / 9};
  return static_cast<std::size_t>(std::clamp<std::int64_t>(quarter - lowest, 0, most)) * incidence_classes + incidence;
}

struct Sums {
  double dof, mean_square;
  std::array<double, 4> x;
};

struct Candidate {
  std::array<double, 4> part{};
  double minus_two_log_likelihood = std::numeric_limits<double>::infinity();
};

double variance_of(const std::array<double, 4>& part, const Sums& cell) {
  double v = 0;
  for (std::size_t k = 0; k < part.size(); ++k) v += part[k] * cell.x[k];
  return v;
}

Candidate most_likely(const std::vector<Sums>& cells, unsigned mask) {
  double largest = 0;
  for (const Sums& cell : cells) largest = std::max(largest, cell.mean_square);
  const double floor = least_part * largest;
  const auto deviance = [&](const std::array<double, 4>& part) {
    double sum = 0;
    for (const Sums& cell : cells) {
      const double v = std::max(variance_of(part, cell), floor);
      sum += cell.dof * (std::log(v) + cell.mean_square / v);
    }
    return sum;
  };
  double all = 0;
  for (const Sums& cell : cells) all += cell.dof;
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < 4; ++k)
    if (mask & (1u << k)) columns.push_back(k);
  Candidate best;
  std::vector<double> v;  // start: every cell's own mean square, shrunk to the mean of all
  double mean = 0;
  for (const Sums& cell : cells) mean += cell.dof * cell.mean_square / all;
  for (const Sums& cell : cells) v.push_back((cell.dof * cell.mean_square + 2 * mean) / (cell.dof + 2));
  for (int step = 0; step < most_steps; ++step) {
    Triangle triangle(columns.size() + 1);
    Matrix rows(cells.size(), columns.size() + 1);
    for (std::size_t j = 0; j < cells.size(); ++j) {
      const double root = std::sqrt(cells[j].dof) / std::max(v[j], floor);
      for (std::size_t k = 0; k < columns.size(); ++k) rows(j, k) = root * cells[j].x[columns[k]];
      rows(j, columns.size()) = root * cells[j].mean_square;
    }
    triangle.add(rows, cells.size());
    const std::size_t n = columns.size();
    const auto rhs = triangle.r().column(n).first(n);
    const std::vector<double> free(n, std::numeric_limits<double>::quiet_NaN());
    const Bounded solution = solve_bounded({triangle.r().top_left(n, n), {rhs.begin(), rhs.end()}, free});
    if (solution.x.size() != n) break;
    std::array<double, 4> part{};
    for (std::size_t k = 0; k < n; ++k) part[columns[k]] = solution.x[k];
    const double next = deviance(part);
    const bool done = std::abs(next - best.minus_two_log_likelihood) <= settled * all;
    if (next < best.minus_two_log_likelihood) best = {part, next};
    if (done) break;
    for (std::size_t j = 0; j < cells.size(); ++j) v[j] = variance_of(part, cells[j]);
  }
  return best;
}

}  // namespace

double VarianceModel::operator()(double f, double tan2_i) const noexcept {
  const double value = std::max(0.0, f);
  return read + shot * value + (gain * gain + tilt * tilt * tan2_i) * value * value;
}

double tan_squared(double cosine) noexcept {
  const double c = std::clamp(cosine, least_cosine, 1.0);
  return (1 - c) * (1 + c) / (c * c);
}

DeviationCells::DeviationCells() : cells_(std::size_t{octaves * per_octave} * incidence_classes) {}

void DeviationCells::clear() noexcept {
  std::fill(cells_.begin(), cells_.end(), Cell{});
  dof_ = 0;
}

void DeviationCells::add(double f, double tan2_i, double square, double dof) noexcept {
  if (!(dof > 0) || !std::isfinite(square) || !std::isfinite(f)) return;
  const double value = std::max(0.0, f);
  Cell& cell = cells_[cell_of(value, tan2_i)];
  cell.dof += dof;
  cell.square += dof * square;
  const std::array<double, 4> x{1, value, value * value, value * value * tan2_i};
  for (std::size_t k = 0; k < x.size(); ++k) cell.regressor[k] += dof * x[k];
  dof_ += dof;
}

void DeviationCells::add(const DeviationCells& other) noexcept {
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    cells_[k].dof += other.cells_[k].dof;
    cells_[k].square += other.cells_[k].square;
    for (std::size_t j = 0; j < cells_[k].regressor.size(); ++j) cells_[k].regressor[j] += other.cells_[k].regressor[j];
  }
  dof_ += other.dof_;
}

double DeviationCells::mean_ratio(const VarianceModel& model) const noexcept {
  const std::array<double, 4> part{model.read, model.shot, model.gain * model.gain, model.tilt * model.tilt};
  double sum = 0;
  for (const Cell& cell : cells_) {
    double v = 0;
    for (std::size_t k = 0; k < part.size(); ++k) v += part[k] * cell.regressor[k];
    if (cell.dof > 0 && v > 0) sum += cell.square / v * cell.dof;
  }
  return dof_ > 0 ? sum / dof_ : 1;
}

double information_criterion(const DeviationCells& cells, const VarianceModel& model) {
  const std::array<double, 4> part{model.read, model.shot, model.gain * model.gain, model.tilt * model.tilt};
  double largest = 0;
  for (const DeviationCells::Cell& cell : cells.cells_)
    if (cell.dof > 0) largest = std::max(largest, cell.square / cell.dof);
  double sum = 0;
  for (const DeviationCells::Cell& cell : cells.cells_) {
    if (!(cell.dof > 0)) continue;
    double v = 0;
    for (std::size_t k = 0; k < part.size(); ++k) v += part[k] * cell.regressor[k] / cell.dof;
    v = std::max({v, least_part * largest, std::numeric_limits<double>::min()});
    sum += cell.dof * std::log(v) + cell.square / v;
  }
  for (const double value : part) sum += value > 0 ? std::log(std::max(1.0, cells.dof())) : 0;
  return sum;
}

VarianceModel variance_model(const DeviationCells& cells) {
  std::vector<Sums> sums;
  double square = 0;
  for (const DeviationCells::Cell& cell : cells.cells_) {
    if (!(cell.dof > 0)) continue;
    Sums one{cell.dof, cell.square / cell.dof, cell.regressor};
    for (double& x : one.x) x /= cell.dof;
    sums.push_back(one);
    square += cell.square;
  }
  VarianceModel model;
  if (sums.empty() || !(square > 0)) return model;
  model.read = square / cells.dof();
  if (cells.dof() < enough_dof) return model;

  const double penalty = std::log(cells.dof());
  double least = std::numeric_limits<double>::infinity();
  unsigned chosen = 0;
  const auto consider = [&](unsigned mask) {
    const Candidate candidate = most_likely(sums, mask);
    const double criterion = candidate.minus_two_log_likelihood + penalty * std::popcount(mask);
    if (!(criterion < least)) return;
    least = criterion, chosen = mask;
    model = {candidate.part[0], candidate.part[1], std::sqrt(candidate.part[2]), std::sqrt(candidate.part[3])};
  };
  for (unsigned mask = 1; mask < 8; ++mask) consider(mask);
  if (chosen & gain_part) {
    consider(chosen | tilt_part);
    consider((chosen & ~gain_part) | tilt_part);
  }
  return model;
}

double truncated_second_moment(double k) noexcept {
  const double tail = normal_upper_tail(k), density = std::exp(-k * k / 2) / std::sqrt(2 * std::numbers::pi);
  return 1 - 2 * tail - 2 * k * density + 2 * k * k * tail;
}

}  // namespace gonio::fitting
