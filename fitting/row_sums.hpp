// SPDX-License-Identifier: BSD-3-Clause
// Least-squares sums of rows that are too many to be held one by one.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fitting/linear_part.hpp"

namespace gonio::fitting {

/// Of a model with one nonlinear parameter, under a metric that is linear in f.
class RowSums {
 public:
  virtual ~RowSums() = default;
  /// The triangle of [basis | f] of all rows at a value of the nonlinear parameter, one per channel.
  virtual std::vector<Matrix> triangles(double parameter, int threads) const = 0;
  /// The value next to `parameter` that the sums can be had at exactly.
  virtual double nearest(double parameter) const = 0;
  /// The sums of a part of the rows, for a search.
  virtual std::shared_ptr<RowSums> few(int threads) const = 0;
  virtual std::size_t rows() const noexcept = 0;
};

}  // namespace gonio::fitting
