// SPDX-License-Identifier: BSD-3-Clause
// The rows of a CSV file as numbers, before any of them has become a BRDF value.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "tabulated/formats/csv_columns.hpp"

namespace gonio::tabulated {

/// Columns of equal length, values as the file has them; rows that are masked by themselves are counted and left out.
struct CsvTable {
  CsvMetadata metadata;
  CsvLayout layout;
  std::array<std::vector<double>, 4> angles;  ///< in the unit of `layout`; an azimuth the file has not is 0
  std::vector<std::vector<double>> values;    ///< [channel][row]
  std::vector<std::vector<double>> u;         ///< [channel][row], or empty
  std::vector<std::vector<double>> extras;    ///< [layout.extras][row]
  std::vector<double> wavelength_nm;          ///< [row], or empty
  MaskedCounts masked;
  std::size_t row_count = 0;  ///< rows of the file, masked ones included

  std::size_t size() const noexcept { return angles[theta_i].size(); }
};

/// Throws Error(input) with all faults of the file.
CsvTable read_csv_table(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
