// SPDX-License-Identifier: BSD-3-Clause
// The half-vector lobe as Ngan et al. fitted it.
#pragma once

#include "brdf/models/half_vector_lobe.hpp"

namespace gonio {

/// f = ρd/π + ρs (s+2)/(2π) cos^s θh: the constant normalises the distribution of half vectors, not the BRDF, so the albedo of
/// the lobe at the normal is 4(2^{-s/2}+s)/(s+4), up to 4. Energy: ρd + ρs 4(2^{-s/2}+s)/(s+4) <= 1.
struct BlinnPhongNgan : HalfVectorLobe<BlinnPhongNgan> {
  static constexpr std::string_view name = "blinn-phong-ngan";
  static constexpr std::string_view citation = "A. Ngan, F. Durand, W. Matusik, Experimental Analysis of BRDF Models, EGSR 2005";
  static constexpr PeakName peak{"rho_s (s+2)", "1", 2 * std::numbers::pi};

  template <class T>
  static T norm(const T& s) {
    return phong_norm(s);
  }
};

}  // namespace gonio
