// SPDX-License-Identifier: BSD-3-Clause
// Tabular scatter files of LightTools (.bsdf).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Key words like those of a Zemax file, but absolute outgoing angles (`ScatterRadial` from the normal, in transmission from -z) and blocks
/// `AOI, POI, Side, Wavelength, ScatterType, TristimulusValue, TIS`, each with azimuth rows of radial values, f in 1/sr. The light of an
/// isotropic table comes from azimuth 90°, so specular is 270° (how libbsdf reads such files; the vendor publishes no layout). Trap: .bsdf
/// is also the name of Zemax' and RGL's files.
/// A file may hold both sides of the surface, in reflection and transmission: then `--assume side=front|back` and
/// `--assume scatter=BRDF|BTDF` choose. Several planes of incidence (POI) are refused: how they turn is not known.
/// Channels X, Y, Z, or one per wavelength (nm). Throws Error(input) with all faults.
Dataset read_lighttools(const std::filesystem::path& path, const ReadOptions& options);

bool recognises_lighttools(std::string_view head, std::uintmax_t size);
Opened open_lighttools(const std::filesystem::path& path, const ReadOptions& options);

/// On the grid of the source's samples if they have one, else on `direction_grid`, over the full turn of azimuths. Unknown and negative
/// values are 0. Throws Error(input) for an anisotropic source.
ExportNotes write_lighttools(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
