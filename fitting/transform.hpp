// SPDX-License-Identifier: BSD-3-Clause
// The function of f whose residual a metric squares, with its slope.
#pragma once

#include <cmath>

#include "fitting/fit.hpp"

namespace gonio::fitting {

/// φ of a metric: the residual is φ(f̂) - φ(f). For `linear_cos` the cosine stands in the weight (cos²θi), so φ is f itself.
/// T is double or an automatic-differentiation type in f; the cosine is always a double.
struct Transform {
  Metric metric = Metric::linear;

  /// The residual is linear in f, so linear parameters have a closed form.
  bool linear() const noexcept { return metric == Metric::linear || metric == Metric::linear_cos; }

  template <class T>
  T value(const T& f, double cos_i) const {
    using std::cbrt;
    using std::log;
    using std::log1p;
    switch (metric) {
      case Metric::log: return log(f);
      case Metric::log1p: return log1p(f * cos_i);
      case Metric::cbrt: return cbrt(f);
      default: return f;
    }
  }
  /// dφ/df. Infinite for cbrt at 0.
  double slope(double f, double cos_i) const noexcept {
    switch (metric) {
      case Metric::log: return 1 / f;
      case Metric::log1p: return cos_i / (1 + f * cos_i);
      case Metric::cbrt: return 1 / (3 * std::cbrt(f) * std::cbrt(f));
      default: return 1;
    }
  }
  /// f with φ(f) = value.
  double inverse(double value, double cos_i) const noexcept {
    switch (metric) {
      case Metric::log: return std::exp(value);
      case Metric::log1p: return cos_i > 0 ? std::expm1(value) / cos_i : 0;
      case Metric::cbrt: return value * value * value;
      default: return value;
    }
  }
  /// Whether the measured value has a φ: f > 0 under log, 1 + f cos θi > 0 under log1p.
  bool defined(double f, double cos_i) const noexcept {
    if (metric == Metric::log) return f > 0;
    if (metric == Metric::log1p) return 1 + f * cos_i > 0;
    return true;
  }
};

}  // namespace gonio::fitting
