// SPDX-License-Identifier: BSD-3-Clause
// gonio fit: parameters of a model from any BRDF file, from several together, or from many one by one.
#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>

#include "tools/fit_batch.hpp"
#include "tools/fit_choice.hpp"
#include "tools/fit_job.hpp"
#include "tools/fit_lines.hpp"
#include "tools/fit_merge.hpp"
#include "tools/residual_picture.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

using Stopwatch = std::chrono::steady_clock;

/// One name a line, from a file or `-` for standard input; empty lines are none.
std::vector<std::string> names_from(const std::string& list) {
  std::ifstream file;
  if (list != "-") file.open(list);
  std::istream& in = list == "-" ? std::cin : file;
  if (!in) throw Error(ErrorKind::input, {list, "no readable file", "a list of files, one a line"});
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) out.push_back(line);
  return out;
}

int fit_together(const std::vector<std::string>& files, const FitRequest& request, const std::string& out, const std::string& picture,
                 Stopwatch::time_point start, Console& console) {
  std::vector<HashedInput> hashes;
  if (console.json || !out.empty()) hashes = hash_inputs(files, request.read);
  const FitInput input = read_inputs(files, request.read, console);
  FitOutcome outcome = fit_input(input, request.fit);
  if (!hashes.empty()) {
    Json where_from = context(hashes, std::nullopt, input.simulated);  // waits for the hashes
    outcome.timings.total_s = std::chrono::duration<double>(Stopwatch::now() - start).count();
    const Json document = fit_document(outcome.result, input.masked, outcome.timings, std::move(where_from), request.options);
    if (!out.empty()) write_file_atomically(out, document.dump(2) + "\n");
    if (console.json) console.print_json(document);
  }
  if (!picture.empty()) draw_residuals(outcome.result, picture);
  if (!console.json)
    for (const std::string& line : fit_lines(outcome.result, input.masked)) console.print(line);
  return outcome.result.status == fitting::Status::converged ? 0 : 1;
}

}  // namespace

int fit_verb(const Arguments& arguments, Console& console) {
  const auto start = Stopwatch::now();
  CLI::App app(
      "Fits a model to samples or a table; prints parameters with profile intervals. Several files or a folder are fitted one by one, "
      "a JSON line each, or --together.",
      "fit");
  std::vector<std::string> names;
  std::string list;
  FitFlags flags;
  ChoiceFlags choice;
  BatchOptions batch;
  bool together = false, merge = false, lines = false;
  std::string picture;
  app.add_option("FILE", names, "Any readable BRDF files, or folders of them");
  app.add_option("--files-from", list, "More files, one a line; - reads standard input");
  flags.add_to(app);
  choice.add_to(app);
  app.add_flag("--together", together, "One fit of all files");
  app.add_flag("--merge", merge, "FILE are statistics of gonio collapse: one fit of all their samples");
  app.add_flag("--lines", lines, "JSON lines for a single file too");
  app.add_option("--jobs", batch.jobs, "Files fitted at a time (default: as many as processors)")->check(CLI::PositiveNumber);
  app.add_option("--out", batch.out, "Write the JSON document, or the JSON lines, to this file");
  app.add_option("--residual-map", picture, "Draw where the model misses the data as this PNG (one fit, with gnuplot)");
  app.add_flag("--resume", batch.resume, "JSON lines: go on with --out, leaving out what stands there");
  app.add_flag("--ordered", batch.ordered, "JSON lines in the order of the files");
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const std::vector<std::string> models = several_models(flags.fit.model);
  const FitRequest request = models.empty() ? flags.request() : flags.request(models);
  if (!list.empty()) {
    const std::vector<std::string> more = names_from(list);
    names.insert(names.end(), more.begin(), more.end());
  }
  const std::vector<std::string> files = expand_folders(names);
  if (files.empty()) throw Error(ErrorKind::usage, {"gonio fit", "no file", "FILE, or a folder with measurements in it"});
  if (batch.resume && batch.out.empty()) throw Error(ErrorKind::usage, {"--resume", "no --out", "the file of JSON lines to go on with"});
  const bool one_by_one = models.empty() && !together && !merge && (lines || files != names || files.size() > 1 || !list.empty());
  if (!picture.empty() && (merge || !models.empty() || one_by_one))
    throw Error(ErrorKind::usage, {"--residual-map", "no single fit of samples", "one model and one file, or --together"});
  if (merge) {
    if (lines || together || batch.resume || batch.ordered || !models.empty())
      throw Error(ErrorKind::usage, {"--merge", "a batch or several models", "one model for all statistics together"});
    return fit_merged(files, request, batch.out, console);
  }
  if (!models.empty()) {
    if (lines || batch.resume || batch.ordered || (files.size() > 1 && !together))
      throw Error(ErrorKind::usage, {"--model", "several models for many files", "one file, or --together; or a single model"});
    return fit_choice(files, models, request, choice, batch.jobs, batch.out, console);
  }
  if (one_by_one) return fit_batch(files, request, batch, console);
  if (batch.resume || batch.ordered) throw Error(ErrorKind::usage, {"--resume, --ordered", "a single fit", "several files, or --lines"});
  return fit_together(files, request, batch.out, picture, start, console);
}

}  // namespace gonio::tools
