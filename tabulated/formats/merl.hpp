// SPDX-License-Identifier: BSD-3-Clause
// MERL's `.binary` files: 34 992 012 bytes, three int32 dimensions and three planes of doubles, little-endian.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "brdf/brdf.hpp"
#include "tabulated/half_difference_table.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

constexpr std::size_t merl_header_size = 12;
constexpr std::size_t merl_file_size = merl_header_size + 3 * MerlGrid::cell_count * sizeof(double);
static_assert(merl_file_size == 34992012);

bool recognises_merl(std::string_view head, std::uintmax_t size);

/// Maps the file and looks at every number once (a table with a NaN or an infinity is damaged: the format marks a missing cell by a
/// negative number). Throws Error(input) with the bytes, dimensions or cells found and wanted.
/// The node rule is `options.merl_nodes`, else the sidecar's (`<path>.json`), else left.
Opened open_merl(const std::filesystem::path& path, const ReadOptions& options);

/// Tabulates a BRDF on the grid and writes the file and its sidecar: values at the nodes of `options.merl_nodes`, or, for readers that
/// take the nearest cell, means over the cells (`options.merl_values`; the sidecar then names the centre as node). Cells without a
/// known value, with a negative one and without a pair of directions above the horizon hold -1 in all channels. One channel is written
/// to all three planes, three as they are. A BRDF that is not isotropic or not reciprocal is taken at phi_h = 0 and phi_d below 180°,
/// which the notes say. Throws Error(input) for another number of channels, an infinite value, or a file that cannot be written; then
/// nothing is left behind.
ExportNotes write_merl(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

/// `<path>.json`, which says what the format cannot: the node rule.
std::filesystem::path merl_sidecar(const std::filesystem::path& path);
const char* name(MerlNodes nodes) noexcept;

}  // namespace gonio::tabulated
