// SPDX-License-Identifier: BSD-3-Clause
// The nonlinear parameters that a fit looks for, on the axes of its search.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fitting/model_kernel.hpp"

namespace gonio::fitting {

/// One nonlinear parameter on its axis z: its logarithm or itself (Parameter::axis).
struct SearchAxis {
  std::size_t parameter = 0;  ///< its place among the nonlinear parameters
  bool logarithmic = true;
  double low = 0, high = 0;            ///< ends of the search on the axis: the bounds of the model, or the caller's
  double scan_low = 0, scan_high = 0;  ///< where it looks first: the scan range of the model within those

  double coordinate(double value) const;
  double value(double coordinate) const;
  /// d value / d coordinate at a value.
  double slope(double value) const { return logarithmic ? value : 1; }
};

/// What the caller asks of one nonlinear parameter: a value (NaN: fit it), or bounds (NaN: those of the model).
struct Wanted {
  double held, lower, upper;
};

/// The free nonlinear parameters. Terms of a sum that are of the same model and treated alike can change places without changing the
/// model; a search that does not put them in order finds every minimum several times (label switching).
class SearchSpace {
 public:
  /// `wanted`: one per nonlinear parameter. `alike[t]`: whether the linear parameters of term t's lobe are all free and unbounded, so
  /// that it may change places with its like.
  SearchSpace(const ModelKernel& kernel, const std::vector<Wanted>& wanted, const std::vector<bool>& alike);

  std::size_t dimension() const noexcept { return axes_.size(); }
  const std::vector<SearchAxis>& axes() const noexcept { return axes_; }
  /// All nonlinear parameters, held ones included, at a point of the space.
  std::vector<double> theta(std::span<const double> z) const;
  std::vector<double> coordinates(std::span<const double> theta) const;
  /// Whether a point has its equal terms in order: broad lobes first, by their first nonlinear parameter.
  bool ordered(std::span<const double> theta) const;
  /// Puts equal terms in order, their linear parameters in every channel along with them.
  void order(std::vector<double>& theta, std::vector<std::vector<double>>& linear) const;
  /// Whether there are terms to be put in order.
  bool has_equal_terms() const noexcept { return !groups_.empty(); }

 private:
  struct Group {
    std::vector<std::size_t> terms;  ///< of the sum, in its order
    std::size_t linear = 0;          ///< linear parameters of a lobe
    std::size_t nonlinear = 0;
    bool ascending = true;  ///< a larger first parameter makes the lobe narrower
  };
  const ModelKernel* kernel_;
  std::vector<double> held_;
  std::vector<SearchAxis> axes_;
  std::vector<Group> groups_;
};

}  // namespace gonio::fitting
