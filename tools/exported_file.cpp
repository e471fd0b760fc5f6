// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exported_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <system_error>
#include <utility>

#include "brdf/error.hpp"
#include "tools/export_document.hpp"
#include "tools/renderer_targets.hpp"

namespace gonio::tools {
namespace {

std::string reason_of(const Error& error) {
  if (error.faults().empty()) return error.what();
  const Fault& fault = error.faults().front();
  return fmt::format("found {}, wanted {}", fault.found, fault.wanted);
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.replace(at, 1, "\\|");
  return text;
}

std::string fact(const tabulated::ExportNotes& notes, const std::string& key) {
  for (const auto& [name, words] : notes.facts)
    if (name == key) return words;
  return "";
}

bool is_renderer_format(const tabulated::Format& format) {
  const auto& list = renderer_formats();
  return &format >= list.data() && &format < list.data() + list.size();
}

}  // namespace

bool needs_table(const tabulated::Format& format, const TableFlags& flags) {
  if (is_renderer_format(format)) return false;
  return !format.writes_samples || flags.resample || flags.imposed() != Symmetry{};
}

ExportedFile export_file(const tabulated::Format& format, const tabulated::Opened& source, const std::filesystem::path& out,
                         const tabulated::WriteOptions& options, bool read_back, const std::string& guide) {
  ExportedFile file;
  file.format = &format;
  file.out = out;
  const auto begin = std::chrono::steady_clock::now();
  file.notes = format.write(source, out, options);
  file.write_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::error_code none;
  for (const auto& written : file.notes.files)
    if (const std::uintmax_t size = std::filesystem::file_size(written, none); !none) file.bytes += size;
  if (read_back && is_renderer_format(format))
    file.not_read_back = "renderers read it, gonio does not";
  else if (read_back)
    file.read_back = round_trip(source, file.notes, guide, options.threads, file.not_read_back);
  return file;
}

std::vector<ExportedFile> export_all(const tabulated::Opened& source, const std::filesystem::path& folder, const std::string& stem,
                                     const tabulated::WriteOptions& options, const TableFlags& flags, const TableReport& table) {
  std::vector<ExportedFile> out;
  std::string guide = "auto";
  for (const auto* list : {&tabulated::formats(), &renderer_formats()})
    for (const tabulated::Format& format : *list) {
      if (!format.write) continue;
      try {
        if (needs_table(format, flags)) require_covered(stem, flags, table);
        out.push_back(
            export_file(format, source, folder / fmt::format("{}_{}{}", stem, format.name, format.extension), options, true, guide));
        if (const auto& back = out.back().read_back; back && !back->guide.empty()) guide = back->guide;
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::input && error.kind() != ErrorKind::usage) throw;
        ExportedFile refused;
        refused.format = &format;
        refused.refused = reason_of(error);
        out.push_back(std::move(refused));
      }
    }
  return out;
}

Json::Members exported_members(const ExportedFile& file) {
  return {{"format", file.format->name},
          {"out", file.out.string()},
          {"bytes", static_cast<std::int64_t>(file.bytes)},
          {"write_ms", 1e3 * file.write_s},
          {"notes", notes_document(file.notes)},
          {"round_trip", file.read_back || !file.not_read_back.empty() ? round_trip_document(file.read_back, file.not_read_back) : Json()}};
}

Json::Members exported_members(const std::vector<ExportedFile>& files) {
  Json exports = Json::array(), refused = Json::array();
  for (const ExportedFile& file : files)
    if (file.refused.empty())
      exports.push_back(Json(exported_members(file)));
    else
      refused.push_back(Json::object({{"format", file.format->name}, {"reason", file.refused}}));
  return {{"exports", std::move(exports)}, {"refused", std::move(refused)}};
}

std::string exported_page(const std::vector<ExportedFile>& files, const std::string& title, const std::vector<std::string>& table_lines) {
  std::string out = fmt::format("# {}\n\n", title);
  if (!table_lines.empty()) {
    out += "```\n";
    for (const std::string& line : table_lines) out += line + "\n";
    out += "```\n\n";
  }
  out +=
      "| format | file | bytes | ms to write | grid | nodes | unknown | negative | extrapolated | round trip: mean | 95th percentile | ms "
      "to read |\n";
  out += "|---|---|---:|---:|---|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const ExportedFile& file : files) {
    if (!file.refused.empty()) continue;
    out += fmt::format("| {} | {} | {} | {:.0f} | {} | {} | {} | {} | {} | {} | {} | {} |\n", file.format->name,
                       file.out.filename().string(), file.bytes, 1e3 * file.write_s, cell(fact(file.notes, "grid")), file.notes.n_nodes,
                       file.notes.n_unknown, file.notes.n_negative, file.notes.n_extrapolated,
                       file.read_back ? fmt::format("{:.3g} %", 100 * file.read_back->mean) : cell(file.not_read_back),
                       file.read_back ? fmt::format("{:.3g} %", 100 * file.read_back->p95) : "",
                       file.read_back ? fmt::format("{:.0f}", 1e3 * file.read_back->read_s) : "");
  }
  for (const ExportedFile& file : files) {
    if (!file.refused.empty() || file.notes.lost.empty()) continue;
    out += fmt::format("\n## Lost in {}\n\n", file.format->name);
    for (const std::string& sentence : file.notes.lost) out += "- " + sentence + "\n";
  }
  std::vector<std::pair<std::string, std::string>> refused;  // names by reason
  for (const ExportedFile& file : files) {
    if (file.refused.empty()) continue;
    const auto same = std::find_if(refused.begin(), refused.end(), [&](const auto& entry) { return entry.second == file.refused; });
    if (same == refused.end())
      refused.emplace_back(file.format->name, file.refused);
    else
      same->first += std::string(", ") + file.format->name;
  }
  if (!refused.empty()) out += "\n## Refused\n\n";
  for (const auto& [names, reason] : refused) out += fmt::format("- {}: {}\n", names, reason);
  return out;
}

}  // namespace gonio::tools
