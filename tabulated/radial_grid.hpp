// SPDX-License-Identifier: BSD-3-Clause
// Angles from the specular direction, close where the BRDF bends.
#pragma once

#include <span>
#include <vector>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// At most `count` radial angles from 0 to 180° (at least 20): starting from steps of 10° the interval is halved, again and again, on
/// which a straight line errs most, in parts of the value (values below 1e-4 of the largest of their incidence count as that), at
/// any of the incidences, at 8 azimuths and, if the source is anisotropic, at 4 azimuths of the light. It stops early where nothing errs by
/// more than 1e-3. Intervals below 0.01° are left.
std::vector<double> radial_grid(const Opened& source, std::span<const double> incidence_deg, Side side, std::size_t count, int threads);

/// Incidences of a table by its size: 9, 18 or 45 from 0 to 89°.
std::vector<double> incidence_grid(GridSize size);

/// first, first + step, … last.
std::vector<double> even_angles(double first, double last, double step);

}  // namespace gonio::tabulated
