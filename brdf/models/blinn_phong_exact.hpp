// SPDX-License-Identifier: BSD-3-Clause
// The half-vector lobe, normalised exactly at normal incidence.
#pragma once

#include "brdf/models/half_vector_lobe.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+2)(s+4)/(8π(2^{-s/2}+s)) cos^s θh. Energy: ρd + ρs <= 1.
struct BlinnPhongExact : HalfVectorLobe<BlinnPhongExact> {
  static constexpr std::string_view name = "blinn-phong-exact";
  static constexpr std::string_view citation =
      "J. F. Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977; normalisation F. Giesen, Phong "
      "Normalization Factor Derivation, 2009";
  static constexpr PeakName peak{"rho_s (s+2)(s+4)/(s+2^(-s/2))", "1", 8 * std::numbers::pi};

  template <class T>
  static T norm(const T& s) {
    return blinn_phong_exact_norm(s);
  }
};

}  // namespace gonio
