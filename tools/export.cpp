// SPDX-License-Identifier: BSD-3-Clause
// gonio export: a table or a fit as a renderer's format, with what the file could not hold.
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "data-schemas/document.hpp"
#include "tools/brdf_source.hpp"
#include "tools/export_document.hpp"
#include "tools/exported_file.hpp"
#include "tools/measured_table.hpp"
#include "tools/output.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

tabulated::GridSize size_named(const std::string& text) {
  if (text == "paper") return tabulated::GridSize::paper;
  if (text == "standard") return tabulated::GridSize::standard;
  if (text == "fine") return tabulated::GridSize::fine;
  throw Error(ErrorKind::usage, {"--size", "'" + text + "'", "paper, standard or fine"});
}

/// `1%` or `0.01`.
double error_named(const std::string& text) {
  const bool percent = text.ends_with('%');
  const double value = number_from(percent ? text.substr(0, text.size() - 1) : text, "--error") * (percent ? 0.01 : 1);
  if (!(value > 0 && value < 1)) throw Error(ErrorKind::usage, {"--error", "'" + text + "'", "a part above 0 and below 1, such as 1%"});
  return value;
}

tabulated::MerlValues merl_values_named(const std::string& text) {
  if (text == "node") return tabulated::MerlValues::node;
  if (text == "cell-mean") return tabulated::MerlValues::cell_mean;
  throw Error(ErrorKind::usage, {"--merl-values", "'" + text + "'", "node or cell-mean"});
}

Json source_members(const std::string& in, const tabulated::Opened& opened, const TableReport& table) {
  Json document = Json::object({{"context", context({hash_in_background(in)}, std::nullopt, opened.simulated)}});
  document.set("samples", opened.dataset ? Json(static_cast<std::int64_t>(opened.dataset->size())) : Json());
  document.set("n_masked", masked_document(opened.masked));
  document.set("table", table.guides.empty() && table.imposed.empty() ? Json() : table_document(table));
  return document;
}

void report(Console& console, const std::string& in, const tabulated::Opened& opened, const TableReport& table, const ExportedFile& file) {
  if (console.json) {
    Json document = source_members(in, opened, table);
    for (auto& [key, value] : exported_members(file)) document.set(key, std::move(value));
    console.print_json(document);
    return;
  }
  console.print(fmt::format("{} ({}) -> {} ({}, {} bytes)", in, opened.format, file.out.string(), file.format->name, file.bytes));
  for (const std::string& line : table_lines(table)) console.print(line);
  for (const std::string& line : notes_lines(file.notes)) console.print(line);
  if (file.read_back)
    console.print(fmt::format("  {:<22} mean {:.3g} %, 95th percentile {:.3g} %, largest {:.3g} % over {} values", "round trip",
                              100 * file.read_back->mean, 100 * file.read_back->p95, 100 * file.read_back->largest, file.read_back->n));
  else if (!file.not_read_back.empty())
    console.print(fmt::format("  {:<22} none: {}", "round trip", file.not_read_back));
}

/// All formats into a folder, with notes.md and notes.json.
void report_all(Console& console, const std::string& in, const tabulated::Opened& opened, const TableReport& table,
                const std::filesystem::path& folder, const std::vector<ExportedFile>& files) {
  Json document = source_members(in, opened, table);
  for (auto& [key, value] : exported_members(files)) document.set(key, std::move(value));
  write_file_atomically(folder / "notes.json", document.dump(2) + "\n");
  const std::string page =
      exported_page(files, fmt::format("{} ({})", std::filesystem::path(in).filename().string(), opened.format), table_lines(table));
  write_file_atomically(folder / "notes.md", page);
  if (console.json)
    console.print_json(document);
  else
    console.print(page);
}

}  // namespace

int export_verb(const Arguments& arguments, Console& console) {
  CLI::App app("Writes a table or a fit as a renderer's format.", "export");
  std::string in, out, to, size = "standard", error, all, merl_values = "node";
  int threads = 2;
  bool read_back = false, scene = false;
  ReadFlags flags;
  TableFlags table_flags;
  app.add_option("FILE", in, "Any readable BRDF file, a fit.json included")->required();
  auto* to_option = app.add_option("--to", to, "Format to write: " + writable_formats());
  auto* out_option = app.add_option("--out", out, "Output file")->needs(to_option);
  to_option->needs(out_option);
  app.add_option("--all", all, "Instead: every format that takes the data, into this folder, with notes.md and notes.json")
      ->excludes(to_option)
      ->excludes(out_option);
  app.add_option("--size", size, "How fine the grid is: paper, standard or fine");
  app.add_option("--error", error, "Take the smallest grid whose reader gets this mean relative error, such as 1%");
  app.add_option("--merl-values", merl_values, "MERL: values at the nodes (node), or cell-mean for readers that take the nearest cell");
  app.add_flag("--round-trip", read_back, "Read the file back and say how far its values are from the source's");
  app.add_flag("--scene", scene,
               "Also a scene that shows the file on a sphere, for every renderer that loads it; --all always writes them");
  app.add_option("--threads", threads, "Threads")->check(CLI::Range(1, 256));
  table_flags.add_to(app);
  flags.add_to(app);
  add_common(app, console);
  if (!parse(app, arguments)) return 0;
  if (to.empty() && all.empty()) throw Error(ErrorKind::usage, {"gonio export", "neither --to nor --all", "one of them"});

  tabulated::WriteOptions options;
  options.threads = threads;
  options.scene = scene || !all.empty();
  options.size = size_named(size);
  if (!error.empty()) {
    if (!all.empty() || !writable_format(to).adaptive)
      throw Error(ErrorKind::usage, {"--error", all.empty() ? "--to " + to : "--all", "a format whose grid can be chosen"});
    options.error = error_named(error);
  }
  if (!flags.merl_nodes.empty()) options.merl_nodes = merl_nodes_named(flags.merl_nodes);
  options.merl_values = merl_values_named(merl_values);
  table_flags.imposed();
  if (all.empty()) {
    writable_format(to);  // refused before anything is read
    const std::filesystem::path folder = std::filesystem::path(out).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder))
      throw Error(ErrorKind::input, {"--out " + out, "no folder " + folder.string(), "a folder that exists"});
  } else {
    std::error_code failed;
    std::filesystem::create_directories(all, failed);
    if (failed || !std::filesystem::is_directory(all))
      throw Error(ErrorKind::input, {"--all " + all, "no folder and none can be made", "a folder"});
  }
  const tabulated::Opened opened = tabulated::open_brdf(in, flags.options());
  console.note_masked(in, opened.masked);
  TableReport table;
  const bool interpolates = all.empty() && needs_table(writable_format(to), table_flags);
  // What is read back is interpolated, and is held against the source interpolated alike.
  const bool tabulates = !all.empty() || interpolates || read_back;
  const tabulated::Opened source = tabulates ? measured_table(opened, table_flags, threads, table) : opened;
  if (interpolates) require_covered(in, table_flags, table);
  if (const std::string warning = coverage_warning(table); !warning.empty()) console.note(fmt::format("{}: {}", in, warning));
  if (all.empty()) {
    report(console, in, opened, table, export_file(writable_format(to), source, out, options, read_back, table_flags.guide));
    return 0;
  }
  report_all(console, in, opened, table, all,
             export_all(source, all, std::filesystem::path(in).stem().string(), options, table_flags, table));
  return 0;
}

}  // namespace gonio::tools
