// SPDX-License-Identifier: BSD-3-Clause
// CSV files of laboratories whose columns and conventions are known by their header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

// All of them are read as plain CSV if `--columns` says what the columns are. `--assume isotropic=yes` says of the sample that it is
// (no file tells): then it is evaluated at any azimuth of the light.

/// RT-300S of J&C, columns `azimuth_deg, incidence_deg, receive_deg, RT`: RT is the reading relative to a white read once at incidence 8°
/// and receive 0°, so f = R RT / (pi cos receive) as long as the whole spot is in the field; R is the radiance factor of that white, which
/// the file does not know: `--assume white=1` (a perfect diffuser) or its certified value. The light is at azimuth 90°; azimuth -90 with
/// receive > 0 is the specular side. `--blank FILE` subtracts the readings with the source covered. Where the detector's head is in
/// the beam (within 10° of the incidence and 30° of the plane of incidence on the side of the light) readings are masked as blocked;
/// `--assume blocked=keep` keeps them.
bool recognises_rt300s(std::string_view head, std::uintmax_t size);
Opened open_rt300s(const std::filesystem::path& path, const ReadOptions& options);

/// NIST, T. A. Germer, "Full four-dimensional and reciprocal Mueller matrix bidirectional reflectance distribution function of sintered
/// polytetrafluoroethylene", Applied Optics 56, 2017: columns `lambda` (um), `thetai, phi, thetar, phir` (degrees; thetai is negative, so
/// specular is phir = 0), `f_r11` [1/sr] and 15 normalised elements of the Mueller matrix, which are dropped with a word. One channel per
/// wavelength.
bool recognises_nist(std::string_view head, std::uintmax_t size);
Opened open_nist(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
