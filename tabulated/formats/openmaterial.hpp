// SPDX-License-Identifier: BSD-3-Clause
// Look-up tables of BRDFs of ASAM OpenMATERIAL 3D: JSON.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Where the lines from the white point D65 through the primaries r, g, b of sRGB meet the spectral locus (CIE 1931): where our files have
/// red, green and blue. A file of just these wavelengths is read as r, g, b.
constexpr std::array<double, 3> primary_wavelengths_nm{611.4, 549.1, 464.3};

/// Rows (wavelength [m], theta_i, theta_o, phi_o - phi_i [rad], f [1/sr]) of an isotropic BRDF, sorted; rules in
/// data-schemas/openmaterial-brdf.schema.json. The azimuth is relative to that of the direction to the light, so that mirror reflection is
/// at pi; `--assume specular_azimuth_deg=0` reads a file that counts from the direction the light goes on. A row with null for f or a
/// direction is masked; null for the wavelength in all rows is one channel `value`. All receivers of one solid angle: the half-angle of a
/// round one is the data set's aperture.
///
/// Throws Error(input) with all faults of `brdf` by JSON pointer (rows that are not sorted are one); those of `metadata` stand in `info`.
Opened open_openmaterial(const std::filesystem::path& path, const ReadOptions& options);
bool recognises_openmaterial(std::string_view head, std::uintmax_t size);

/// r, g and b stand at the dominant wavelengths of the primaries of sRGB, one channel of unknown wavelength at null. Negative values,
/// which the schema forbids, become 0; angles end at 1.570796 and 6.283185 as it wants. The uuid is made from the values. Throws
/// Error(input) for transmission and for samples at several phi_i that are not known to be isotropic.
ExportNotes write_openmaterial(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
