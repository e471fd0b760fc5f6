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

struct MerlWriteResult {
  std::size_t below_horizon = 0;  ///< cells whose node has a direction at or below the horizon: no BRDF there
  std::size_t unknown = 0;        ///< cells where the BRDF gave NaN
  std::size_t negative = 0;       ///< cells with a negative value, which the format cannot hold
};

/// Tabulates a BRDF at the nodes and writes the file and its sidecar. Every cell counted in the result holds -1 in all channels.
/// One channel is written to all three planes, three as they are. Throws Error(input) for another number of channels, an
/// infinite value, or a file that cannot be written; then nothing is left behind.
MerlWriteResult write_merl(const Brdf& brdf, const std::filesystem::path& path, const WriteOptions& options, const std::string& source,
                           bool simulated);

/// `<path>.json`, which says what the format cannot: the node rule.
std::filesystem::path merl_sidecar(const std::filesystem::path& path);
const char* name(MerlNodes nodes) noexcept;

}  // namespace gonio::tabulated
