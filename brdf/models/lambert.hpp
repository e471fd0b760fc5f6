// SPDX-License-Identifier: BSD-3-Clause
// The ideal diffuse reflector.
#pragma once

#include <array>
#include <numbers>

#include "brdf/model.hpp"

namespace gonio {

/// f = ρd / π. Radiance is equal in every direction.
struct Lambert {
  static constexpr std::string_view name = "lambert";
  static constexpr std::string_view citation = "J. H. Lambert, Photometria, 1760";
  static constexpr std::array<Parameter, 1> parameters{{{"rho_d", "1", 0, 1e6, true}}};
  static constexpr DependsOn depends_on = DependsOn::nothing;
  static constexpr ModelProperties properties{true, true, true};

  template <class T>
  static void basis(const LobeGeometry&, const T*, T* out) {
    out[0] = T(1 / std::numbers::pi);
  }
  static void albedo(Angle, const double*, double* out) { out[0] = 1; }
  static void albedo_bound(const double*, double* out) { out[0] = 1; }
};

}  // namespace gonio
