// SPDX-License-Identifier: BSD-3-Clause
// gonio tradeoff: what accuracy costs in time, as table, plot and advice.
#include "tools/tradeoff/tradeoff.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "tools/gnuplot.hpp"
#include "tools/progress_bar.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

constexpr std::size_t percent = 100;

const tradeoff::Topic& topic_named(const std::string& name) {
  std::string known;
  for (const tradeoff::Topic& topic : tradeoff::topics()) {
    if (topic.name == name) return topic;
    known += (known.empty() ? "" : ", ") + std::string(topic.name);
  }
  throw Error(ErrorKind::usage, {"TOPIC", "'" + name + "'", "one of " + known});
}

}  // namespace

int tradeoff_verb(const Arguments& arguments, Console& console) {
  std::string summaries, name, out;
  for (const tradeoff::Topic& topic : tradeoff::topics())
    summaries += (summaries.empty() ? "" : "; ") + std::string(topic.name) + " (" + std::string(topic.summary) + ")";
  CLI::App app("Measures what accuracy costs in time; writes TOPIC.json, .csv, .svg and .png, and says what to choose.", "tradeoff");
  tradeoff::Effort effort;
  app.add_option("TOPIC", name, summaries)->required();
  app.add_option("--out", out, "Folder for the four files")->required();
  app.add_flag("--quick", effort.quick, "Fewer settings and shorter runs: less than 10 s");
  add_common(app, console);
  if (!parse(app, arguments)) return 0;
  const tradeoff::Topic& topic = topic_named(name);
  const std::filesystem::path folder = out;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed || !std::filesystem::is_directory(folder))
    throw Error(ErrorKind::input, {"--out " + out, "no folder and none can be made", "a folder"});

  tradeoff::Measured measured;
  {
    ProgressBar bar(console, "tradeoff " + name, percent);
    effort.progress = [&](double part, std::string_view what) { bar.reach(static_cast<std::size_t>(percent * part), std::string(what)); };
    measured = topic.measure(effort);
  }
  tradeoff::mark_front(measured.points, measured.by_size);
  const auto file = [&](const char* ending) { return folder / (name + ending); };
  const Json document = tradeoff::document(name, effort.quick, measured, context({}, tradeoff::seed, true));
  write_file_atomically(file(".json"), document.dump(2) + "\n");
  write_file_atomically(file(".csv"), tradeoff::csv(measured));
  const auto draw = [&](const char* ending, const char* terminal) {
    draw_with_gnuplot(file(ending), [&](const auto& output) { return tradeoff::plot_script(measured, terminal, output.string()); });
  };
  draw(".svg", "svg font 'DejaVu Sans,13'");
  draw(".png", "pngcairo font 'DejaVu Sans,11'");

  if (console.json)
    console.print_json(document);
  else {
    console.print(document.at("advice").string());
    console.print(fmt::format("{} points: {}, .csv, .svg, .png", measured.points.size(), file(".json").string()));
  }
  return 0;
}

}  // namespace gonio::tools
