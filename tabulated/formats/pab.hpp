// SPDX-License-Identifier: BSD-3-Clause
// The files of pab's goniophotometers ("Mountain"): one incidence a file, as Radiance's pabopto2bsdf takes them.
#pragma once

#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Lines `#key value` and rows theta_o phi_o value (three values X, Y, Z after `#colorimetry: CIE-XYZ`), degrees. Keys: `#format: theta
/// phi BSDF` (f; also BRDF, BTDF) or DSF (f cos theta_o), `#incident_angle THETA PHI` or `#intheta`, `#inphi`, `#upphi` (which azimuth
/// is up: kept, not applied), `#sample_name`. Both directions point away from the sample; light from below (theta > 90°) is seen with the
/// sample turned over its x axis. Trap: Radiance takes a missing `#upphi` as 0 and turns everything by 90°.
bool recognises_pab(std::string_view head, std::uintmax_t size);
/// Samples of one incidence. Rows on both sides of the sample ask for `--assume side=reflection|transmission`. Throws Error(input) with
/// the lines of all faults.
Opened open_pab(const std::filesystem::path& path, const ReadOptions& options);

/// One file per incidence: `path`, then `-002`, `-003`, ... before its extension. The source's samples as they are, or the grid of
/// `direction_grid` with the full turn of azimuths. Rows that are not known in every channel are left out; negative values become 0, as
/// pabopto2bsdf takes logarithms. Throws Error(input) for a source without values; then no file is left behind.
ExportNotes write_pab(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
