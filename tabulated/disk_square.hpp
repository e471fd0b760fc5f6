// SPDX-License-Identifier: BSD-3-Clause
// The area-preserving map between the unit disk and the unit square.
#pragma once

#include <array>

namespace gonio::tabulated {

/// A point of the disk of radius 1 about the origin as a point of [0, 1]², and back: concentric squares become concentric circles, and
/// equal areas stay equal (P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square", Journal of Graphics Tools 2(3), 1997).
/// The disk is a hemisphere seen from above (x and y of a direction), so equal areas of the square are equal *projected* solid angles.
/// Trap: Radiance measures the azimuth from +x to the side of the square where its first coordinate is 1, as here; other programs turn
/// the square by 90°.
std::array<double, 2> square_of_disk(double x, double y) noexcept;
std::array<double, 2> disk_of_square(double u, double v) noexcept;

}  // namespace gonio::tabulated
