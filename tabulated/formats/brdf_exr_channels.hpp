// SPDX-License-Identifier: BSD-3-Clause
// Names shared by the writer and the reader of `.brdf.exr`.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "brdf/channels.hpp"

namespace gonio::tabulated {

inline constexpr const char* exr_attribute_prefix = "gonio.";
inline constexpr std::array exr_direction_channels{"theta.high", "theta.low", "phi.high", "phi.low"};
inline constexpr std::array exr_deviation_channels{"theta_i", "phi_i", "theta_o", "phi_o"};

/// The image channel of every channel of the data: R, G, B or Y where viewers know them, else `f.<name>`.
std::vector<std::string> exr_channel_names(const Channels& channels);
/// The channel to show as Y beside spectral ones: nearest 555 nm, where the eye is most sensitive, by its wavelength or by a name
/// such as 550nm; else the first.
std::size_t exr_shown_channel(const Channels& channels);

}  // namespace gonio::tabulated
