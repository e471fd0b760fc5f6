// SPDX-License-Identifier: BSD-3-Clause
// gonio import: from any readable format to ours.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "tools/brdf_source.hpp"
#include "tools/output.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

void report(Console& console, const std::string& in, const std::string& out, const tabulated::Format& format,
            const tabulated::Opened& opened) {
  if (console.json) {
    Json document = Json::object(
        {{"context", context({hash_in_background(in)}, std::nullopt, opened.simulated)}, {"format", format.name}, {"out", out}});
    if (opened.dataset) document.set("samples", static_cast<std::int64_t>(opened.dataset->size()));
    document.set("n_masked", masked_document(opened.masked));
    console.print_json(document);
    return;
  }
  console.print(fmt::format("{} ({}) -> {} ({}{})", in, opened.format, out, format.name,
                            opened.dataset ? fmt::format(", {} samples", opened.dataset->size()) : std::string()));
}

}  // namespace

int import_verb(const Arguments& arguments, Console& console) {
  CLI::App app("Reads any supported format and writes ours: .csv or .brdf.exr by the name of the output.", "import");
  std::string in, out;
  ReadFlags flags;
  app.add_option("FILE", in, "Any readable BRDF file")->required();
  app.add_option("--out", out, "Output: NAME.csv or NAME.brdf.exr")->required();
  flags.add_to(app);
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const tabulated::Format& format = format_of_name(out);
  const tabulated::Opened opened = tabulated::open_brdf(in, flags.options());
  console.note_masked(in, opened.masked);
  if (opened.dataset)
    if (const auto left_out = opened.dataset->provenance.find("columns_left_out"); left_out != opened.dataset->provenance.end())
      console.note(fmt::format("{}: columns left out: {}", in, left_out->second));
  format.write(opened, out, {});
  report(console, in, out, format, opened);
  return 0;
}

}  // namespace gonio::tools
