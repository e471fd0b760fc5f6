// SPDX-License-Identifier: BSD-3-Clause
// A BRDF that knows how sure it is of every value.
#pragma once

#include <cstdint>
#include <span>

#include "brdf/brdf.hpp"

namespace gonio {

/// How a value came about, from the best to the worst.
enum class Coverage : std::uint8_t {
  measured,      ///< at a sample
  interpolated,  ///< between samples
  extrapolated,  ///< beyond the samples, or in a region that was masked: a guess, bounded but not measured
  unknown,       ///< no value: f is NaN
};

const char* name(Coverage coverage) noexcept;

/// Values with their uncertainty: what a table made from measurements is.
class UncertainBrdf : public Brdf {
 public:
  /// As `eval`, and for every value its standard uncertainty (k = 1, total, 1/sr; NaN = unknown, never 0) and how it came about.
  /// f and u have n · C entries, f[k · C + c]; coverage has n.
  virtual void eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f, std::span<double> u,
                                     std::span<Coverage> coverage) const = 0;
};

}  // namespace gonio
