// SPDX-License-Identifier: BSD-3-Clause
// `.brdf.exr`: a table of samples as an OpenEXR file of several parts, all float32.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"
#include "tabulated/sample_table.hpp"

namespace gonio::tabulated {

/// Parts, with one displayWindow of n x m pixels (row = incident, column = outgoing):
///   `value` [1/sr, cosine not included], `uncertainty` [1/sr, k = 1], `count`: n x m;
///   `incident`: 1 x m and `outgoing`: n x 1, theta and phi in degrees, each as the sum of a high and a low float;
///   `coverage` (only if the samples have that column): n x m, 0 measured, 1 interpolated, 2 extrapolated, NaN in empty cells;
///   `deviation` (only if a pose differs from its row and column): n x m, four angles in degrees;
///   `sensitivity` (only if a component of uncertainty varies): n x m, d ln f / d name, one channel per component.
/// Channels: R, G, B for r, g, b; Y for a single one; otherwise `f.<name>` each, and in `value` a Y to look at (the one nearest
/// 555 nm, else the first). What the data set says about itself stands in string attributes `gonio.<key>` of `value`.
/// Float data keep their bits; double data are within 6e-8 of their value, angles within 1e-12 degrees.
///
/// Throws Error(input) if a value does not fit a float, a name does not fit a channel, or the file cannot be written.
void write_brdf_exr(const SampleTable& table, const std::filesystem::path& path);

/// Throws Error(input) with all faults: not OpenEXR, damaged, another kind of image, parts or channels that are missing or do not
/// fit together, directions or values that are none.
SampleTable read_brdf_exr(const std::filesystem::path& path);

bool recognises_brdf_exr(std::string_view head, std::uintmax_t size);
Opened open_brdf_exr(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
