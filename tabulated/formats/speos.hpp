// SPDX-License-Identifier: BSD-3-Clause
// Scatter files of Ansys SPEOS as text (.brdf, .anisotropicbsdf).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Ansys help, "Structure of BRDF files" and "Structure of anisotropic BSDF files", versions 8 and 9, text mode. Blocks of zenith angles
/// (above 90° in transmission) by azimuths, azimuth 0 on the side of the specular direction. Values are f, or f cos theta_o if the file
/// says intensity. Of a .brdf each block has a percentage that SPEOS scales it to; where the block's own integral of f cos theta_o differs
/// by more than 5 % from it, `--assume scale=stored|percentage` has to say which holds. An .anisotropicbsdf holds f at one unnamed
/// wavelength; its spectrum is kept as text. Several anisotropy angles do not say in which sense they turn: `--assume
/// rotation=counter-clockwise|clockwise` (azimuth of the light 180° ± angle). A file with both kinds of scatter asks for `--assume
/// scatter=BRDF|BTDF`. Throws Error(input) with the faults.
Dataset read_speos(const std::filesystem::path& path, const ReadOptions& options);

bool recognises_speos(std::string_view head, std::uintmax_t size);
Opened open_speos(const std::filesystem::path& path, const ReadOptions& options);

/// A .brdf of version 9.0, on the grid of the source's samples if they have one, else on `direction_grid`, the full turn of azimuths;
/// spectra as they are, red, green and blue as smooth spectra, one channel as a constant one. The percentages are the integrals of the
/// tables themselves, so that SPEOS takes the values as they are. Unknown and negative values are 0. Not tried with SPEOS itself. Throws
/// Error(input) for an anisotropic source.
ExportNotes write_speos(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
