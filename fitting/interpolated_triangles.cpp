// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/interpolated_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr double digits = 1e-11;  // of the largest element
constexpr std::size_t fewest_nodes = 5, most_nodes = 10;

/// Enough for `digits` where the elements are analytic within π/2 of the axis, as those of lobes are in the logarithm of their width: every
/// further node brings the factor π/reach (Bernstein's ellipse).
std::size_t nodes_for(double reach) {
  const double factor = std::numbers::pi / reach;
  if (!(factor > 1)) return most_nodes;
  return std::clamp(static_cast<std::size_t>(2 - std::log(digits) / std::log(factor)), fewest_nodes, most_nodes);
}

double& last(Matrix& r) { return r(r.rows() - 1, r.columns() - 1); }

/// R with its diagonal positive, for the signs of its rows are an accident of the decomposition, and the last of it squared.
void make_smooth(Matrix& r) {
  for (std::size_t row = 0; row < r.rows(); ++row)
    if (r(row, row) < 0)
      for (std::size_t k = row; k < r.columns(); ++k) r(row, k) = -r(row, k);
  last(r) *= last(r);
}

}  // namespace

InterpolatedTriangles::InterpolatedTriangles(double low, double high, int threads, const std::function<Node(double place)>& at)
    : node_(nodes_for(0.5 * (high - low))) {
  const std::size_t nodes = node_.size();
  const double middle = 0.5 * (low + high), reach = 0.5 * (high - low);
  for_each_index(nodes, threads, [&](std::size_t k) {
    node_[k] = at(middle - reach * std::cos(std::numbers::pi * static_cast<double>(k) / static_cast<double>(nodes - 1)));
    for (Matrix& r : node_[k].triangles) make_smooth(r);
  });
  for (std::size_t k = 0; k < nodes; ++k) {
    double product = 1;
    for (std::size_t j = 0; j < nodes; ++j)
      if (j != k) product *= (node_[k].place - node_[j].place) / reach;
    weight_.push_back(1 / product);
  }
}

std::vector<Matrix> InterpolatedTriangles::at(double place) const {
  const std::size_t nodes = node_.size();
  std::vector<double> part(nodes, 0.0);
  double whole = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    const double apart = place - node_[k].place;
    if (apart == 0) {
      std::fill(part.begin(), part.end(), 0.0);
      part[k] = whole = 1;
      break;
    }
    part[k] = weight_[k] / apart;
    whole += part[k];
  }
  std::vector<Matrix> out;
  for (std::size_t c = 0; c < node_.front().triangles.size(); ++c) {
    Matrix& r = out.emplace_back(node_.front().triangles[c].rows(), node_.front().triangles[c].columns());
    for (std::size_t k = 0; k < nodes; ++k)
      for (std::size_t column = 0; column < r.columns(); ++column)
        for (std::size_t row = 0; row <= column; ++row) r(row, column) += part[k] / whole * node_[k].triangles[c](row, column);
    last(r) = std::sqrt(std::max(0.0, last(r)));
  }
  return out;
}

}  // namespace gonio::fitting
