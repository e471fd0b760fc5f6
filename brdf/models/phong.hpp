// SPDX-License-Identifier: BSD-3-Clause
// The normalised Phong lobe.
#pragma once

#include "brdf/models/mirror_lobe.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+2)/(2π) cos^s ψ with ψ the angle between wo and the mirror direction of wi; 0 for ψ >= 90°, at s = 0 too.
/// (s+2)/(2π) is exact at normal incidence only; the albedo falls towards grazing. Energy: ρd + ρs <= 1, exactly.
struct Phong : MirrorLobe<Phong> {
  static constexpr std::string_view name = "phong";
  static constexpr std::string_view citation =
      "E. P. Lafortune, Y. D. Willems, Using the Modified Phong Reflectance Model for Physically Based Rendering, report CW197, 1994";
  static constexpr auto parameters = MirrorLobe::parameters_with("1");

  static constexpr PeakName peak{"rho_s (s+2)", "1", 2 * std::numbers::pi};

  template <class T>
  static T norm(const T& s) {
    return phong_norm(s);
  }
};

}  // namespace gonio
