// SPDX-License-Identifier: BSD-3-Clause
// Surface properties of TracePro with a table of scatter (.txt).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// The `Table_BSDF_Data` of a `TracePro Surface Property Data` file (TracePro help, "Surface Property Import/Export Format"): temperature
/// [K], wavelength [um], incidence [deg], its azimuth [deg], |β - β0|, azimuth of β - β0 [deg], BRDF, BTDF [1/sr]; β and β0 are the
/// outgoing and the specular direction projected on the surface. Where that azimuth counts from is set when the property is applied, not in
/// the file:
/// `--assume zero_azimuth=across` (from the normal of the plane of incidence, 90° being forward) or `zero_azimuth=fixed` (from the sample's
/// x axis); files of ours say it in their description, and tables of one azimuth do not need it. A table of both kinds of scatter asks for
/// `--assume scatter=BRDF|BTDF`. Nodes beyond the horizon are masked, and so are values that are `nan`.
/// A table of all combinations of its angles is evaluated linearly between them up to the horizon; other rows are samples.
/// Throws Error(input) with all faults.
Opened open_tracepro(const std::filesystem::path& path, const ReadOptions& options);

bool recognises_tracepro(std::string_view head, std::uintmax_t size);

/// An asymmetric table at `incidence_grid`, azimuths in steps of 30, 15 or 10° and 20, 40 or 80 values of |β - β0| from 0 to 2, close to 0.
/// One channel (of colours the luminance), at 0.55 um if its wavelength is unknown, which is said. Unknown, negative and below-horizon
/// nodes are 0. Not tried with TracePro itself. Throws Error(input) for an anisotropic source.
ExportNotes write_tracepro(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
