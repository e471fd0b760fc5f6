// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/marginal_warp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gonio::tabulated {
namespace {

/// The cell of a grid of nodes a coordinate lies in, and where in it.
struct Cell {
  std::size_t low;
  double part;
};

Cell cell_of(double coordinate, std::size_t nodes) noexcept {
  const double at = std::clamp(coordinate, 0.0, 1.0) * static_cast<double>(nodes - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), nodes - 2);
  return {low, at - static_cast<double>(low)};
}

double mixed(double a, double b, double weight) noexcept { return (1 - weight) * a + weight * b; }

/// The integral from 0 to `part` of a density that runs linearly from `first` to `last` over a cell.
double integral_to(double part, double first, double last) noexcept { return part * (first + 0.5 * part * (last - first)); }

/// The part of a cell at which that integral is `amount`: the root of a quadratic in the form that does not cancel.
double part_at(double amount, double first, double last) noexcept {
  const double root = first + std::sqrt(std::max(0.0, first * first + 2 * amount * (last - first)));
  return root > 0 ? std::clamp(2 * amount / root, 0.0, 1.0) : 0;
}

/// The last of `count` non-decreasing numbers but one that is below `amount`: the cell in which the integral reaches it.
template <class Value>
std::size_t cell_reaching(std::size_t count, double amount, Value&& value) {
  std::size_t low = 0, high = count - 1;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (value(middle) < amount ? low : high) = middle;
  }
  return low;
}

}  // namespace

Neighbours neighbours_in(const std::vector<float>& increasing, double at) noexcept {
  const std::size_t last = increasing.size() - 1;
  if (!(at > static_cast<double>(increasing.front()))) return {0, 0, 0};
  if (at >= static_cast<double>(increasing.back())) return {last, last, 0};
  // Halving without branches: which half it is nobody can predict.
  const float* below = increasing.data();
  for (std::size_t count = last; count > 1;) {
    const std::size_t half = count / 2;
    below = static_cast<double>(below[half]) <= at ? below + half : below;
    count -= half;
  }
  const auto high = static_cast<std::size_t>(below - increasing.data()) + 1;
  const double a = static_cast<double>(below[0]), b = static_cast<double>(below[1]);
  return {high - 1, high, (at - a) / (b - a)};
}

double bilinear(const float* values, std::size_t rows, std::size_t columns, UnitPoint at) noexcept {
  const Cell x = cell_of(at.x, columns), y = cell_of(at.y, rows);
  const float* low = values + y.low * columns + x.low;
  const float* high = low + columns;
  const auto along = [&](const float* row) { return mixed(static_cast<double>(row[0]), static_cast<double>(row[1]), x.part); };
  return mixed(along(low), along(high), y.part);
}

double MarginalWarp::integral(const float* density, std::size_t rows, std::size_t columns) noexcept {
  double sum = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    double along = 0;
    for (std::size_t column = 0; column < columns; ++column) {
      const bool border = column == 0 || column + 1 == columns;
      along += (border ? 0.5 : 1.0) * static_cast<double>(density[row * columns + column]);
    }
    sum += (row == 0 || row + 1 == rows ? 0.5 : 1.0) * along;
  }
  return sum;
}

MarginalWarp::MarginalWarp(std::vector<float> density, std::size_t rows, std::size_t columns)
    : slices_(density.size() / (rows * columns)),
      rows_(rows),
      columns_(columns),
      nodes_(density.size()),
      row_sums_(slices_ * rows),
      scale_(slices_) {
  for (std::size_t slice = 0; slice < slices_; ++slice) {
    const float* values = density.data() + slice * rows * columns;
    const double scale = 1 / integral(values, rows, columns);
    scale_[slice] = scale;
    Node* node = nodes_.data() + slice;
    Row* sums = row_sums_.data() + slice * rows;
    for (std::size_t row = 0; row < rows; ++row, values += columns) {
      double before = 0;
      for (std::size_t k = 0; k < columns; ++k, node += slices_) {
        const float next = k + 1 < columns ? values[k + 1] : 0;
        *node = {before, values[k], next};
        if (k + 1 < columns) before += 0.5 * scale * (static_cast<double>(values[k]) + static_cast<double>(next));
      }
      sums[row].whole = before;
      sums[row].before = row == 0 ? 0 : sums[row - 1].before + 0.5 * (sums[row - 1].whole + sums[row].whole);
    }
  }
}

std::vector<float> MarginalWarp::density() const {
  std::vector<float> out;
  out.reserve(nodes_.size());
  for (std::size_t slice = 0; slice < slices_; ++slice)
    for (std::size_t node = slice; node < nodes_.size(); node += slices_) out.push_back(nodes_[node].density);
  return out;
}

inline UnitPoint MarginalWarp::inverted(const SliceWeights& slices, std::size_t row, std::size_t node, double y, double x) const noexcept {
  // The densities at both ends of the cell, or the integrals of both rows.
  typedef double Two __attribute__((vector_size(16)));
  Two density{}, whole{};
  double before = 0, rows_before = 0;
  for (std::size_t k = 0; k < slices.slice.size(); ++k) {
    const double weight = slices.weight[k];
    if (weight == 0) continue;
    const std::size_t slice = slices.slice[k];
    const Row* const rows = row_sums_.data() + slice * rows_ + row;
    const Node *const low = nodes_.data() + node * slices_ + slice, *const high = low + columns_ * slices_;
    const double of_high = weight * y, of_low = weight - of_high, scale = scale_[slice];
    const auto both = [](const Node* of) { return Two{static_cast<double>(of->density), static_cast<double>(of->next)}; };
    density += of_low * scale * both(low) + of_high * scale * both(high);
    before += of_low * low->before + of_high * high->before;
    whole += weight * Two{rows[0].whole, rows[1].whole};
    rows_before += weight * rows[0].before;
  }
  const double in_row = mixed(whole[0], whole[1], y);
  UnitPoint out;
  out.x = in_row > 0 ? (before + integral_to(x, density[0], density[1])) / in_row : std::numeric_limits<double>::quiet_NaN();
  out.y = rows_before + integral_to(y, whole[0], whole[1]);
  return out;
}

UnitPoint MarginalWarp::invert(const SliceWeights& slices, UnitPoint at) const noexcept {
  const Cell x = cell_of(at.x, columns_), y = cell_of(at.y, rows_);
  return inverted(slices, y.low, y.low * columns_ + x.low, y.part, x.part);
}

void MarginalWarp::invert(const SliceWeights* slices, const SquareCells& cells, std::size_t count, SquareColumn& y,
                          SquareColumn& x) const noexcept {
  for (std::size_t k = 0; k < count; ++k) {
    const UnitPoint to = inverted(slices[k], cells.row[k], cells.node[k], cells.y[k], cells.x[k]);
    y[k] = to.y, x[k] = to.x;
  }
}

UnitPoint MarginalWarp::sample(std::size_t slice, UnitPoint uniform) const noexcept {
  constexpr double border = 6e-8;  // half a unit in the last place of a float below 1
  const double across = std::clamp(uniform.y, border, 1 - border), along = std::clamp(uniform.x, border, 1 - border);

  const Row* sums = row_sums_.data() + slice * rows_;
  const std::size_t row = cell_reaching(rows_, across, [&](std::size_t k) { return sums[k].before; });
  const Node* low = nodes_.data() + row * columns_ * slices_ + slice;
  const Node* high = low + columns_ * slices_;
  const double y = part_at(across - sums[row].before, sums[row].whole, sums[row + 1].whole);

  const auto reached = [&](std::size_t k) { return mixed(low[k * slices_].before, high[k * slices_].before, y); };
  const double amount = along * reached(columns_ - 1);
  const std::size_t column = cell_reaching(columns_, amount, reached);
  const auto density = [&](std::size_t k) {
    return scale_[slice] * mixed(static_cast<double>(low[k * slices_].density), static_cast<double>(high[k * slices_].density), y);
  };
  const double x = part_at(amount - reached(column), density(column), density(column + 1));
  return {(static_cast<double>(column) + x) / static_cast<double>(columns_ - 1),
          (static_cast<double>(row) + y) / static_cast<double>(rows_ - 1)};
}

}  // namespace gonio::tabulated
