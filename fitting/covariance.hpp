// SPDX-License-Identifier: BSD-3-Clause
// The covariance of all parameters where it exists.
#pragma once

#include <optional>
#include <vector>

#include "fitting/linearisation.hpp"

namespace gonio::fitting {

/// Every parameter in one order: the linear ones channel by channel, then the nonlinear ones.
struct ParameterPlaces {
  std::size_t channels = 0, linear = 0, nonlinear = 0;

  std::size_t size() const noexcept { return channels * linear + nonlinear; }
  std::size_t of_linear(std::size_t channel, std::size_t k) const noexcept { return channel * linear + k; }
  std::size_t of_nonlinear(std::size_t j) const noexcept { return channels * linear + j; }
};

/// scale · (JᵀJ)⁺ from the singular values of the joint Jacobian with columns of unit length. NaN in the rows and columns of a parameter
/// that is held, lies at a bound or has no effect, and of one whose part in the null space is larger than 0.1: a pseudo-inverse would
/// call it perfectly known (numerics D.5).
Matrix covariance(const Linearisation& at, const ParameterPlaces& places, const SearchSpace& space, double scale);

/// The variance of a function of the parameters with this gradient; none if the gradient has a part of more than 0.1 in the null space,
/// or touches a parameter that does not move.
std::optional<double> variance_of(const Linearisation& at, const ParameterPlaces& places, const SearchSpace& space, double scale,
                                  const std::vector<double>& gradient);

/// How far every right-hand side of `at` moves every parameter, [right-hand side][parameter]; 0 for those without covariance.
std::vector<std::vector<double>> responses(const Linearisation& at, const ParameterPlaces& places, const SearchSpace& space);

}  // namespace gonio::fitting
