// SPDX-License-Identifier: BSD-3-Clause
// A renderer's own BRDF formula as a parametric function: what a fit is re-fitted to before it is exported.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "brdf/direction.hpp"

namespace gonio {

/// One slot of a renderer's material.
struct FormulaParameter {
  std::string_view name;  ///< as the target calls it
  double lower, upper;    ///< what the target takes, or what its formula is defined for
  bool per_channel;       ///< else shared by all channels
  /// Anisotropy and what else only an anisotropic source needs: the value that stands for isotropic, where it is held for one that is.
  std::optional<double> if_isotropic = std::nullopt;
};

/// [channel][parameter] in the order of the formula; shared parameters are repeated.
using ChannelValues = std::vector<std::vector<double>>;

/// One diffuse part and one lobe in words every renderer has slots for: what a conversion without a refit starts from.
/// F = f0 + (f90 - f0)(1 - cos theta_d)^5; alpha is the GGX width itself (slope scale), not its square root.
struct LobeSummary {
  std::vector<double> rho_d, f0, f90;  ///< per channel
  double alpha_x = 0.2, alpha_y = 0.2;
};

/// f [1/sr] per channel of one pair of directions, cosine not included, 0 below the horizon. wi points to the light, wo to the viewer:
/// not every target's formula is reciprocal.
using EvaluateFormula = std::function<void(const Direction& wi, const Direction& wo, double* f)>;

/// A target's formula. Values outside the bounds are never passed to `prepare`.
struct TargetFormula {
  std::string_view name;                           ///< of the target's material: `roughplastic`
  std::string_view source;                         ///< where the formula stands
  std::string_view roughness, shadowing, fresnel;  ///< the target's conventions, for people
  std::vector<FormulaParameter> parameters;
  /// The function for these values; what does not depend on the directions is computed once, here.
  EvaluateFormula (*prepare)(const ChannelValues& values);
  /// Where a refit starts: the naive conversion of the summary first, as someone would do who copies numbers from slot to slot with the
  /// target's roughness convention; then others from which the least squares may find a better minimum. Within the bounds.
  std::vector<ChannelValues> (*starts)(const LobeSummary& summary);
  std::vector<std::string_view> lacks;  ///< what the formula has no parameter for, one sentence each
};

}  // namespace gonio
