// SPDX-License-Identifier: BSD-3-Clause
// One file written: how large, how long it took, what a reader gets of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "tabulated/open.hpp"
#include "tools/measured_table.hpp"
#include "tools/round_trip.hpp"

namespace gonio::tools {

struct ExportedFile {
  const tabulated::Format* format = nullptr;
  std::filesystem::path out;
  std::string refused;  ///< why there is no file; empty: there is one
  tabulated::ExportNotes notes;
  std::uintmax_t bytes = 0;  ///< of all files of the notes
  double write_s = 0;
  std::optional<RoundTrip> read_back;
  std::string not_read_back;  ///< why there is none
};

/// Whether the format is written from values everywhere: neither from the samples as they are nor from a fit of its own to them.
bool needs_table(const tabulated::Format& format, const TableFlags& flags);

/// Writes, and reads back if asked to, samples with this guide (TableFlags). Lets every error pass.
ExportedFile export_file(const tabulated::Format& format, const tabulated::Opened& source, const std::filesystem::path& out,
                         const tabulated::WriteOptions& options, bool read_back, const std::string& guide = "auto");

/// Every writable format into `folder`, as STEM_FORMAT and the extension; a format that refuses the data (Error of kind input or usage) has
/// its reason, and no file. All of them are read back, samples with the guide that was found for the first file of samples.
/// So has a format of a table of which most would be extrapolated (require_covered).
std::vector<ExportedFile> export_all(const tabulated::Opened& source, const std::filesystem::path& folder, const std::string& stem,
                                     const tabulated::WriteOptions& options, const TableFlags& flags, const TableReport& table);

/// Members `format`, `out`, `bytes`, `write_ms`, `notes`, `round_trip` (null if it was not asked for).
Json::Members exported_members(const ExportedFile& file);
/// `exports` and `refused` of the document of --all.
Json::Members exported_members(const std::vector<ExportedFile>& files);
/// The same as a page: a table of what was written, what each file lost, and what was refused.
std::string exported_page(const std::vector<ExportedFile>& files, const std::string& title, const std::vector<std::string>& table_lines);

}  // namespace gonio::tools
