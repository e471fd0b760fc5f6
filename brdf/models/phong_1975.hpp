// SPDX-License-Identifier: BSD-3-Clause
// Phong's lobe without normalisation.
#pragma once

#include "brdf/models/mirror_lobe.hpp"

namespace gonio {

/// f = ρd/π + ρs cos^s ψ with ψ the angle between wo and the mirror direction of wi; 0 for ψ >= 90°. ρs is in 1/sr here.
/// This is the reciprocal reading as a BRDF: the 1975 shading formula divided by cos θi is neither reciprocal nor bounded.
/// Energy: ρd + 2π ρs/(s+2) <= 1.
struct Phong1975 : MirrorLobe<Phong1975> {
  static constexpr std::string_view name = "phong-1975";
  static constexpr std::string_view citation = "B. T. Phong, Illumination for Computer Generated Pictures, CACM 18(6), 1975";
  static constexpr auto parameters = MirrorLobe::parameters_with("1/sr");

  static constexpr PeakName peak{"rho_s", "1/sr", 1};

  template <class T>
  static T norm(const T&) {
    return T(1.0);
  }
};

}  // namespace gonio
