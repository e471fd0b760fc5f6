// SPDX-License-Identifier: BSD-3-Clause
// Samples as comma-separated text.
#pragma once

#include <filesystem>
#include <string_view>

#include "brdf/dataset.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Reads samples; every quantity becomes f [1/sr] on entry (u with it):
///   f_cos: f = v / cos theta_o; reflectance_factor: f = v / pi; signal_ratio: f = v / (pi cos theta_o).
/// A row at a vanishing cos theta_o has no f and is masked. A negative theta becomes (|theta|, phi + 180°).
///
/// Masked and counted, never a fault: rows without a value (empty, `nan`, `NA` in every channel or in an angle), rows whose
/// channels are all exactly `options.missing`, |theta| > 90° in a reflection file. Kept: every other negative, and theta = 90°.
/// Throws Error(input) with all faults: text, an infinity, u <= 0, a wrong number of columns, a missing or unknown column, no
/// sample left, a direction the blank does not have.
Dataset read_csv(const std::filesystem::path& path, const ReadOptions& options = {});

/// Writes a file that `read_csv` turns back into the same data set, bit for bit (angles in degrees, or in radians where they were
/// made so). Throws Error(input) if the file cannot be written or a name of a channel is one of another column.
void write_csv(const Dataset& dataset, const std::filesystem::path& path);

bool recognises_csv(std::string_view head, std::uintmax_t size);
Opened open_csv(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
