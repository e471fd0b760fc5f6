// SPDX-License-Identifier: BSD-3-Clause
// The pictures of a comparison.
#pragma once

#include <filesystem>
#include <string>

#include "brdf/channels.hpp"
#include "fitting/difference_image.hpp"

namespace gonio::tools {

/// Pixels across one disc.
constexpr std::size_t difference_disc_size = 181;

/// A PNG by gnuplot: the discs with their incidence, the light's, the mirror's direction and circles at 30° and 60°; blue where B is darker
/// than A, red where it is brighter, grey where nothing is known. The scale ends at the 98th percentile.
void draw_difference_png(const fitting::DifferenceImage& image, const std::string& title, const std::filesystem::path& png);
/// The same discs as numbers: one channel of signed relative difference for each channel compared.
void write_difference_exr(const fitting::DifferenceImage& image, const Channels& channels, const std::filesystem::path& exr);

}  // namespace gonio::tools
