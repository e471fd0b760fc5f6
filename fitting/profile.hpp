// SPDX-License-Identifier: BSD-3-Clause
// The cost as a function of the nonlinear parameters alone, the linear ones eliminated.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fitting/interpolated_triangles.hpp"
#include "fitting/linear_part.hpp"
#include "fitting/search_space.hpp"
#include "fitting/terms.hpp"

namespace gonio::fitting {

/// What the linear parameters of one channel may be.
struct LinearLimits {
  std::vector<double> held;          ///< NaN where free
  std::vector<double> lower, upper;  ///< empty: 0 and no bound
};

/// One channel at one set of nonlinear parameters: its least cost, and the least-squares system of its linear parameters there (exact for
/// the linear metrics, linearised at the solution for the others). cost = |R x - rhs|² + rest.
struct ChannelPart {
  std::vector<double> x;
  SmallSystem system;
  double rest = 0;
  double cost = 0;
};

struct ProfilePoint {
  std::vector<double> theta;  ///< every nonlinear parameter
  std::vector<ChannelPart> channel;
  double cost = 0;  ///< of all channels, the constants of collapsed blocks included

  std::vector<std::vector<double>> linear() const;  ///< [channel][k]
};

/// Variable projection (Golub and Pereyra 1973, numerics D.1): for given nonlinear parameters the linear ones are found by bounded least
/// squares; for log, log1p and cbrt by Gauss-Newton steps of that kind, shortened until the cost falls.
class Profile {
 public:
  /// One set of limits per channel. The terms must outlive the profile.
  Profile(const Terms& terms, std::vector<LinearLimits> limits) : terms_(&terms), limits_(std::move(limits)) {}

  const Terms& terms() const noexcept { return *terms_; }
  const std::vector<LinearLimits>& limits() const noexcept { return limits_; }
  /// The same terms with one linear parameter held.
  Profile holding(std::size_t channel, std::size_t k, double value) const;

  /// The one place where linear parameters are eliminated. The result does not depend on the number of threads.
  ProfilePoint at(std::span<const double> theta, int threads = 1) const;

  /// Makes `at` quick between two places on the one free axis, for a metric that is linear in f: the rows are looked at in a few places
  /// and what they say is interpolated. Whether that is good enough is to be told from `at_rows`.
  void prepare(const SearchSpace& space, double low, double high, int threads);
  void forget() noexcept { stretch_.reset(); }
  /// The same as `at`, whatever was prepared.
  ProfilePoint at_rows(std::span<const double> theta, int threads = 1) const;

 private:
  ProfilePoint from_triangles(std::span<const double> theta, const std::vector<Matrix>& triangles) const;
  std::vector<Matrix> triangles(std::span<const double> theta, int threads) const;
  ChannelPart channel_part(std::size_t channel, const Matrix& r) const;
  ChannelPart channel_at(std::size_t channel, const std::vector<double>& columns, int threads) const;
  ChannelPart linearised(std::size_t channel, const std::vector<double>& columns, const std::vector<double>* about, int threads) const;
  double cost_of(std::size_t channel, const std::vector<double>& columns, const std::vector<double>& x) const;

  const Terms* terms_;
  std::vector<LinearLimits> limits_;
  struct Stretch {
    SearchAxis axis;
    InterpolatedTriangles triangles;
  };
  std::shared_ptr<const Stretch> stretch_;
};

}  // namespace gonio::fitting
