// SPDX-License-Identifier: BSD-3-Clause
// The interface of everything that can be evaluated as a BRDF: models and tables.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "brdf/channels.hpp"
#include "brdf/direction.hpp"

namespace gonio {

/// A bidirectional reflectance distribution function f_r(wi, wo) = dL_o/dE_i in 1/sr, **cosine not included**.
/// Immutable after construction and safe to evaluate from several threads.
class Brdf {
 public:
  virtual ~Brdf() = default;

  virtual const Channels& channels() const = 0;
  virtual Symmetry symmetry() const = 0;
  /// Reflectance of an ideal mirror part (a delta lobe) per channel, or none. Not part of `eval`.
  virtual std::optional<std::vector<double>> delta() const { return std::nullopt; }

  /// Values for pairs of directions, all in the sample frame and away from the surface.
  /// wi and wo have n entries, f has n · C: f[k · C + c]. 0 where either direction is below the horizon; NaN where nothing is known.
  virtual void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const = 0;

  /// One pair, one value per channel.
  std::vector<double> eval(const Direction& wi, const Direction& wo) const;
};

}  // namespace gonio
