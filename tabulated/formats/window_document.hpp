// SPDX-License-Identifier: BSD-3-Clause
// The XML of WINDOW and Radiance: what stands where, numbers not yet read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabulated/fault_list.hpp"
#include "tabulated/formats/sheet_side.hpp"
#include "tabulated/klems_basis.hpp"

namespace gonio::tabulated {

/// How the numbers of a block are ordered.
enum class WindowStructure { columns, rows, tree3, tree4 };

/// One <WavelengthDataBlock>.
struct WindowBlock {
  std::string wavelength;  ///< `Visible`, `CIE-X`, `Solar`, ... as the file has it
  SheetSide side;
  std::string column_basis, row_basis, basis;  ///< names, empty if not given
  std::string_view data;
  std::size_t line = 0;         ///< of the element
  std::size_t data_offset = 0;  ///< of `data` in the file
};

struct WindowDocument {
  std::shared_ptr<const void> owner;  ///< keeps the texts alive
  std::string_view text;              ///< the whole file
  WindowStructure structure = WindowStructure::columns;
  std::vector<KlemsBasis> bases;  ///< those the file defines itself
  std::vector<WindowBlock> blocks;
  std::string material, manufacturer;

  /// The file's own definition, or the standard one; null if there is neither.
  const KlemsBasis* basis(const std::string& name) const;
};

/// Words of the format are compared without regard to case, as Radiance does.
bool same_word_of_window(std::string_view a, std::string_view b);
/// Line of an offset into a text, from 1.
std::size_t line_at(std::string_view text, std::size_t offset);

/// Larger files, or files of more elements, are refused before they are parsed: a file of tiny elements would take many times its size.
constexpr std::size_t max_window_file = std::size_t{1} << 28, max_window_elements = 100000;

/// Adds every fault it meets to `faults` and raises them if the document cannot be used. Document types (and so entities of the file's
/// own) are refused.
WindowDocument read_window_document(const std::filesystem::path& path, FaultList& faults);

}  // namespace gonio::tabulated
