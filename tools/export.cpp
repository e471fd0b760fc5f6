// SPDX-License-Identifier: BSD-3-Clause
// gonio export: a table or a fit as a renderer's format, with what the file could not hold.
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "tools/brdf_source.hpp"
#include "tools/export_document.hpp"
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

void report(Console& console, const std::string& in, const std::string& out, const tabulated::Format& format,
            const tabulated::Opened& opened, const tabulated::ExportNotes& notes) {
  if (console.json) {
    Json document = Json::object(
        {{"context", context({hash_in_background(in)}, std::nullopt, opened.simulated)}, {"format", format.name}, {"out", out}});
    if (opened.dataset) document.set("samples", static_cast<std::int64_t>(opened.dataset->size()));
    document.set("n_masked", masked_document(opened.masked));
    document.set("notes", notes_document(notes));
    console.print_json(document);
    return;
  }
  console.print(fmt::format("{} ({}) -> {} ({})", in, opened.format, out, format.name));
  for (const std::string& line : notes_lines(notes)) console.print(line);
}

}  // namespace

int export_verb(const Arguments& arguments, Console& console) {
  CLI::App app("Writes a table or a fit as a renderer's format.", "export");
  std::string in, out, to, size = "standard", error, merl_values = "node";
  ReadFlags flags;
  app.add_option("FILE", in, "Any readable BRDF file, a fit.json included")->required();
  app.add_option("--to", to, "Format to write: " + writable_formats())->required();
  app.add_option("--out", out, "Output file")->required();
  app.add_option("--size", size, "How fine the grid is: paper, standard or fine");
  app.add_option("--error", error, "Take the smallest grid whose reader gets this mean relative error, such as 1%");
  app.add_option("--merl-values", merl_values, "MERL: values at the nodes (node), or cell-mean for readers that take the nearest cell");
  flags.add_to(app);
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const tabulated::Format& format = writable_format(to);
  tabulated::WriteOptions options;
  options.size = size_named(size);
  if (!error.empty()) {
    if (!format.adaptive) throw Error(ErrorKind::usage, {"--error", fmt::format("--to {}", to), "a format whose grid can be chosen"});
    options.error = error_named(error);
  }
  if (!flags.merl_nodes.empty()) options.merl_nodes = merl_nodes_named(flags.merl_nodes);
  options.merl_values = merl_values_named(merl_values);
  const tabulated::Opened opened = tabulated::open_brdf(in, flags.options());
  console.note_masked(in, opened.masked);
  const tabulated::ExportNotes notes = format.write(opened, out, options);
  report(console, in, out, format, opened, notes);
  return 0;
}

}  // namespace gonio::tools
