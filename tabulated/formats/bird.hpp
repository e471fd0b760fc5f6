// SPDX-License-Identifier: BSD-3-Clause
// The universal BRDF data format of the BiRD project: JSON with uncertainties.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// D. Lanevski et al., "Machine-readable universal data format for bidirectional reflectance distribution function", Color Research and
/// Application 47, 2022; rules in data-schemas/bird-brdf.schema.json. A row holds one value of f [1/sr] with its directions (both away
/// from the surface), wavelength and polarisation; rows at equal directions become one sample with a channel per wavelength and
/// polarisation. Numbers in `adhoc_variables` become optional columns where they agree over the rows of a sample.
///
/// **The format does not say what its uncertainties are** (standard or expanded). Their coverage factor is taken from `--assume
/// coverage_factor=K`, else from `metadata.adhoc_section.coverage_factor`, else from a comment of uBRDF or BRDF such as `k = 2`; without
/// any of them a file with uncertainties is refused. u = uncertainty / k; 0 means unknown. `BRDF.uncertainty` holds where there is no
/// uBRDF; % is of the value.
///
/// Throws Error(input) with all faults of `data` by JSON pointer. Faults of `metadata` are no reason to refuse numbers: `info` has them.
Opened open_bird(const std::filesystem::path& path, const ReadOptions& options);
bool recognises_bird(std::string_view head, std::uintmax_t size);

/// A row per value, degrees (the public schema ends azimuths in radians at pi), uBRDF in 1/sr with k = 1, total. Negative values, which
/// the schema forbids, become 0; pairs at theta = 90°, which it forbids too, are left out. Metadata that came from such a file are
/// written again. Throws Error(input) for transmission.
ExportNotes write_bird(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
