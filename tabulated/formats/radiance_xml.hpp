// SPDX-License-Identifier: BSD-3-Clause
// BSDFs as XML of WINDOW and Radiance: matrices over Klems' patches and tensor trees.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

bool recognises_radiance_xml(std::string_view head, std::uintmax_t size);

/// One block of the file, as a table: `--assume kind=reflection|transmission`, `side=front|back` and `wavelength=NAME` choose it; default
/// is reflection, the back (what Radiance shows on the outward side of a surface) and Visible, with colour where the file has it. Every
/// block is checked, taken or not. Throws Error(input) with the lines of all faults.
Opened open_radiance_xml(const std::filesystem::path& path, const ReadOptions& options);

/// A matrix of means over pairs of patches, written as "Reflection Back" and, the sheet turned over, "Reflection Front". Means are
/// weighted by projected solid angle and integrated until they are settled. Negative means become 0, as do pairs of which nothing is
/// known. Three channels r, g, b (or X, Y, Z) become Visible, CIE-X and CIE-Z, equal ones or a single channel Visible alone. Throws
/// Error(input) for other channels and for transmission.
ExportNotes write_radiance_klems_full(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
ExportNotes write_radiance_klems_half(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
ExportNotes write_radiance_klems_quarter(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

/// A tensor tree of rank 3 (isotropic sources only) or 4: cells of equal projected solid angle, joined where they hardly differ. `size`
/// gives the finest division of an axis (rank 3: 32, 64, 128; rank 4: 8, 16, 32); `error` takes the coarsest one that keeps it.
/// Otherwise as above, with CIE-u and CIE-v for colour.
ExportNotes write_radiance_tree3(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
ExportNotes write_radiance_tree4(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
