// SPDX-License-Identifier: BSD-3-Clause
// Tables as pictures: slices of a BRDF below each other in one OpenEXR file, for eyes and shaders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// An isotropic table, float32, channels R, G, B, Y or f.<name>, f in 1/sr, cosine not included. A tile per value of the last angle,
/// from the top; in a tile the first angle goes to the right and the third down:
///   half_difference   tiles phi_d, right theta_h (even steps of its square root), down theta_d
///   spherical         tiles phi_o - phi_i, right theta_i, down theta_o
/// The first and last node lie in the centres of the first and last pixel, and text attributes `gonio.*` say everything needed to look a
/// value up: `atlas` = 1, `coordinates`, `right_deg`, `down_deg`, `tiles_deg` (all angles), `symmetry`, `unit`. Pixels beyond the horizon
/// and unknown ones repeat their neighbour.
ExportNotes write_exr_atlas(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
ExportNotes write_exr_atlas_spherical(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

/// One tile as the BRDF Explorer of Disney shows it (B. Burley, "Physically-Based Shading at Disney", 2012): phi_d = 90°, theta_h to the
/// right and theta_d upwards, both 0 to 90° in even steps, values in the centres of pixels; unknown ones are black.
ExportNotes write_exr_slice(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

/// Reads an atlas of ours back. Throws Error(input) with all faults.
Opened open_exr_atlas(const std::filesystem::path& path, const ReadOptions& options);
bool recognises_exr_atlas(std::string_view head, std::uintmax_t size);

}  // namespace gonio::tabulated
