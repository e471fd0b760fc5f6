// SPDX-License-Identifier: BSD-3-Clause
// Directions that crowd around the specular one.
#pragma once

#include <vector>

#include "acquisition/pose.hpp"

namespace gonio::acquisition {

/// `points` outgoing directions for one incidence, the first of them the specular direction itself. Their angle to it is 90° u^q with
/// u = k/points and q such that half of them lie within `width_deg`; around it they turn by the golden angle, so that no direction is
/// preferred. What would fall below 85° (or, if the light stands lower, below the light) is put on the other side or drawn nearer.
/// phi_o is relative to phi_i = 0; all angles are rounded to a thousandth of a degree, finer than any drive repeats.
std::vector<Pose> specular_density(double theta_i_deg, int points, double width_deg);

}  // namespace gonio::acquisition
