// SPDX-License-Identifier: BSD-3-Clause
// Scenes that show a material file on a sphere, ready to render.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace gonio::tabulated {

/// Writes a scene for every renderer that loads a file of this format by itself, beside the file and named like it: for `rgl` Mitsuba 3
/// (`.xml`, for an RGB mode), for `rgl-spectral` Mitsuba 3 (for a spectral mode) and pbrt-v4 (`.pbrt`), for `radiance-...` Radiance
/// (`.rad`). A sphere of radius 1 about the
/// origin under a distant light and a dim even sky, seen by a camera at 5 radii. The scenes name the file relative to themselves.
/// Returns what was written; nothing for other formats.
std::vector<std::filesystem::path> write_sphere_scenes(std::string_view format, const std::filesystem::path& material);

}  // namespace gonio::tabulated
