// SPDX-License-Identifier: BSD-3-Clause
// Spectral samples of Cornell's Program of Computer Graphics (.brdf).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Comments, the number of wavelengths, the wavelengths (nm), then per sample theta_i, phi_i, theta_s, phi_s in radians and f [1/sr] at
/// every wavelength; specular is phi_s - phi_i = pi. `--assume isotropic=yes` says of the sample that it is, which no file tells. Throws
/// Error(input) with the faults.
Dataset read_cornell(const std::filesystem::path& path, const ReadOptions& options);

bool recognises_cornell(std::string_view head, std::uintmax_t size);
Opened open_cornell(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
