// SPDX-License-Identifier: BSD-3-Clause
// The half-vector lobe with the customary normalisation.
#pragma once

#include "brdf/models/half_vector_lobe.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+8)/(8π) cos^s θh with θh between the half vector and the normal.
/// The normalisation over-reflects: the albedo of the lobe at the normal is A(0;s) = (s+8)(2^{-s/2}+s)/((s+2)(s+4)), up to 1.0752.
/// Energy: ρd + ρs A(0;s) <= 1.
struct BlinnPhong : HalfVectorLobe<BlinnPhong> {
  static constexpr std::string_view name = "blinn-phong";
  static constexpr std::string_view citation =
      "J. F. Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977; (s+8)/(8 pi) as in T. Akenine-Moeller, E. "
      "Haines, N. Hoffman, Real-Time Rendering, 3rd ed., 2008";
  static constexpr PeakName peak{"rho_s (s+8)", "1", 8 * std::numbers::pi};

  template <class T>
  static T norm(const T& s) {
    return blinn_phong_norm(s);
  }
};

}  // namespace gonio
