// SPDX-License-Identifier: BSD-3-Clause
// Which scattering of a flat sheet a table holds, and how its coordinates lie to the sample's.
#pragma once

#include <string>

#include "brdf/channels.hpp"
#include "brdf/direction.hpp"

namespace gonio::tabulated {

/// WINDOW names four: reflection and transmission of light that falls on its front (outdoors) or on its back (indoors). The files count
/// azimuths about the normal of the back for all four. The sample frame's z is the normal of the side the light falls on, so for the
/// front the sheet is turned over about its x axis and y changes its sign.
struct SheetSide {
  Side kind = Side::reflection;
  bool front = false;

  /// +1 or -1: y of the sample frame = this · y of the file.
  double y_sign() const noexcept { return front ? -1 : 1; }
  /// True if a pair of directions, both away from the surface, lies on the sides that the table is about.
  bool holds(const Direction& wi, const Direction& wo) const noexcept {
    return wi.z() > 0 && (kind == Side::reflection ? wo.z() > 0 : wo.z() < 0);
  }
  /// `Reflection Back` and so on.
  std::string name() const;
};

}  // namespace gonio::tabulated
