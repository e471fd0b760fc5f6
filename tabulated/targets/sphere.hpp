// SPDX-License-Identifier: BSD-3-Clause
// One scene in the languages of renderers: a sphere of a material.
#pragma once

#include <string>
#include <string_view>

namespace gonio::tabulated::targets {

/// A sphere of radius 1 about the origin under a distant light (from (-1, -2, 2), irradiance 3 across its rays) and an even sky of radiance
/// 0.2, seen by a camera 5 radii away along -y; z is up. Each takes lines of comment, which may be empty, and the text that makes a
/// material of the name `material`. Arbitrary units, linear sRGB.
std::string mitsuba_sphere(std::string_view comments, std::string_view material);
/// `image` is the file the picture goes to.
std::string pbrt_sphere(std::string_view comments, std::string_view material, std::string_view image);
/// The camera stands in a comment: Radiance takes it on the command line.
std::string radiance_sphere(std::string_view comments, std::string_view material);

}  // namespace gonio::tabulated::targets
