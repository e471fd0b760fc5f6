// SPDX-License-Identifier: BSD-3-Clause
// Ward's Gaussian lobe with two widths.
#pragma once

#include "brdf/models/ward_terms.hpp"

namespace gonio {

/// f = ρd/π + ρs/(4π αx αy √(cos θi cos θo)) e^{-tan²θh (cos²φh/αx² + sin²φh/αy²)} (Eq. 5a). The axes are those of the sample: turn the
/// sample, or its azimuth zero, so that its grain lies along x or y. A scratch along y scatters along x: αx is then the larger.
/// Traps as for `ward`. Mirrored at a plane of incidence off the axes it is another surface, so it does not claim to be bilateral.
struct WardAnisotropic {
  static constexpr std::string_view name = "ward-anisotropic";
  static constexpr std::string_view citation = "G. J. Ward, Measuring and Modeling Anisotropic Reflection, SIGGRAPH 1992";
  static constexpr auto parameters = table(one_lobe_parameters, std::array{ward_width("alpha_x", 0.1), ward_width("alpha_y", 0.3)});
  static constexpr PeakName peak{"rho_s/(alpha_x alpha_y)", "1", 4 * std::numbers::pi};
  static constexpr DependsOn depends_on = DependsOn::all;
  static constexpr ModelProperties properties{true, false, false, false};

  template <class T>
  static void basis(const LobeGeometry& g, const T* nonlinear, T* out) {
    one_lobe_basis(g.has_half_vector() ? ward_gaussian(g, nonlinear[0], nonlinear[1]) * static_cast<Plain<T>>(ward_factor(g)) : T(0), out);
  }
};

}  // namespace gonio
