// SPDX-License-Identifier: BSD-3-Clause
// gonio fit: parameters of a model from any BRDF file.
#include "fitting/fit.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <optional>

#include "brdf/analytic_brdf.hpp"
#include "tools/brdf_source.hpp"
#include "tools/output.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {

int fit_verb(const Arguments& arguments, Console& console) {
  using Stopwatch = std::chrono::steady_clock;
  const auto start = Stopwatch::now();
  const auto seconds = [](auto duration) { return std::chrono::duration<double>(duration).count(); };

  std::string models;
  for (const ModelInfo& info : model_infos()) models += (models.empty() ? "" : ", ") + std::string(info.name);
  CLI::App app("Fits a model to samples or a table; prints parameters with 95 % profile intervals.", "fit");
  std::string file, metric = "linear", out;
  std::vector<std::string> fixed;
  fitting::FitOptions options;
  ReadFlags flags;
  app.add_option("FILE", file, "Any readable BRDF file")->required();
  app.add_option("--model", options.model, "One of " + models)->required();
  app.add_option("--metric", metric, "linear, linear-cos, log, log1p or cbrt");
  app.add_option("--fix", fixed, "NAME=VALUE: hold a parameter")->take_all();
  app.add_flag("--per-channel", options.per_channel, "Nonlinear parameters per channel");
  app.add_option("--out", out, "Write the JSON document to this file");
  flags.add_to(app);
  add_common(app, console);
  if (!parse(app, arguments)) return 0;
  const auto known = fitting::metric_named(metric);
  if (!known) throw Error(ErrorKind::usage, {"--metric", "'" + metric + "'", "linear, linear-cos, log, log1p or cbrt"});
  options.metric = *known;
  model_info(options.model);
  for (const std::string& text : fixed) {
    const auto [name, value] = name_value(text, "--fix");
    options.fixed[name] = number_from(value, "--fix " + name);
  }
  const auto read_options = flags.options();

  const auto read_start = Stopwatch::now();
  std::optional<HashedInput> input;
  if (console.json || !out.empty()) input = hash_in_background(file);
  const tabulated::Opened opened = tabulated::open_brdf(file, read_options);
  if (!opened.observations) throw Error(ErrorKind::input, {file, opened.format + ", a model and not a measurement", "samples or a table"});
  console.note_masked(file, opened.masked);
  FitTimings timings;
  timings.read_s = seconds(Stopwatch::now() - read_start);
  const fitting::FitResult result = fitting::fit(*opened.observations, options);
  timings.fit_s = result.fit_s;

  if (input) {
    Json where_from = context({*input}, std::nullopt, opened.simulated);  // waits for the hash
    timings.total_s = seconds(Stopwatch::now() - start);
    const Json document = fit_document(result, opened.masked, timings, std::move(where_from));
    if (!out.empty()) write_file_atomically(out, document.dump(2) + "\n");
    if (console.json) console.print_json(document);
  }
  if (!console.json)
    for (const std::string& line : fit_lines(result)) console.print(line);
  return result.status == fitting::Status::converged ? 0 : 1;
}

}  // namespace gonio::tools
