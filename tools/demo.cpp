// SPDX-License-Identifier: BSD-3-Clause
// gonio demo: the whole chain on the embedded simulated bench.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "acquisition/sweep.hpp"
#include "data-schemas/document.hpp"
#include "fitting/checks/checks.hpp"
#include "tools/bench_source.hpp"
#include "tools/brdf_source.hpp"
#include "tools/fit_document.hpp"
#include "tools/fit_lines.hpp"
#include "tools/lobe_picture.hpp"
#include "tools/measure.hpp"
#include "tools/reduced_run.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

namespace fs = std::filesystem;
using namespace gonio::acquisition;

struct DemoFiles {
  fs::path folder;
  fs::path bench() const { return folder / "demo.bench.json"; }
  fs::path plan() const { return folder / "demo.plan.json"; }
  fs::path run() const { return folder / "run.gonio"; }
  fs::path samples() const { return folder / "samples.csv"; }
  fs::path table() const { return folder / "table.brdf.exr"; }
  fs::path fit() const { return folder / "fit.json"; }
  fs::path checks() const { return folder / "checks.json"; }
  fs::path merl() const { return folder / "export" / "material.binary"; }
  fs::path rgl() const { return folder / "export" / "material.bsdf"; }
  fs::path picture() const { return folder / "lobe.png"; }
};

void require_empty(const fs::path& folder) {
  std::error_code status;
  if (fs::exists(folder, status) && !fs::is_directory(folder, status))
    throw Error(ErrorKind::input, {folder.string(), "a file", "a folder that is empty or does not exist"});
  if (fs::is_directory(folder, status) && !fs::is_empty(folder, status))
    throw Error(ErrorKind::input, {folder.string(), "a folder that is not empty", "an empty folder, or one that does not exist yet"});
  fs::create_directories(folder / "export", status);
  if (status) throw Error(ErrorKind::input, {folder.string(), status.message(), "a folder that can be made"});
}

std::string relative_error_text(double fitted, double truth) { return fmt::format("{:+.2f} %", 100 * (fitted / truth - 1)); }

}  // namespace

int demo_verb(const Arguments& arguments, Console& console) {
  CLI::App app(
      "Measures a material on the embedded simulated bench, tabulates it, fits Blinn-Phong, checks its physics, exports it and draws the "
      "lobe.",
      "demo");
  std::string folder;
  std::optional<std::uint64_t> seed;
  app.add_option("DIR", folder, "Folder for the results; may exist empty")->required();
  app.add_option("--seed", seed, "Another seed of the noise than the bench file's");
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const auto start = std::chrono::steady_clock::now();
  const DemoFiles files{folder};
  require_empty(folder);
  write_file_atomically(files.bench(), example_text("demo.bench.json"));
  write_file_atomically(files.plan(), example_text("demo.plan.json"));

  console.note("1. Plan: what the bench can reach, in which order");
  const Bench bench = bench_with_seed(files.bench(), seed);
  const PlanRequest request = load_plan(files.plan());
  const SweepPlan plan = make_plan(request, bench);
  for (const std::string& line : plan_lines(plan, bench)) console.note("   " + line);

  console.note("2. Sweep: drives over Modbus TCP and meter over SCPI, all on the virtual clock");
  const auto sample = simulated_sample(bench, files.bench().string(), "", {});
  SweepResult swept;
  {
    Run run = Run::create(files.run(), bench, request, plan);
    swept = measure(run, bench, sample, ClockChoice::bench, console);
  }

  console.note("3. Reduce: samples with uncertainty, and the table");
  tabulated::Opened samples = reduced_run(files.run());
  format_of_name(files.samples().string()).write(samples, files.samples(), {});
  format_of_name(files.table().string()).write(samples, files.table(), {});

  console.note("4. Fit Blinn-Phong");
  fitting::FitOptions options;
  options.model = "blinn-phong";
  FitTimings timings;
  const fitting::FitResult fit = fitting::fit(*samples.observations, options);
  timings.total_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_file_atomically(
      files.fit(),
      fit_document(fit, samples.masked, timings, context({hash_in_background(files.samples())}, bench.seed, true)).dump(2) + "\n");

  console.note("5. Check reciprocity, isotropy, energy, positivity");
  fitting::CheckSubject subject;
  subject.datasets.push_back(samples.dataset);
  const auto checks = fitting::run_checks(subject, {});
  write_file_atomically(files.checks(),
                        checks_document(checks, context({hash_in_background(files.samples())}, bench.seed, true)).dump(2) + "\n");

  console.note("6. Export the fit for renderers, draw the lobe");
  const tabulated::Opened fitted = tabulated::open_brdf(files.fit());
  tabulated::WriteOptions with_scene;
  with_scene.scene = true;
  writable_format("merl").write(fitted, files.merl(), {});
  writable_format("rgl").write(fitted, files.rgl(), with_scene);
  const auto* model = dynamic_cast<const AnalyticBrdf*>(fitted.brdf.get());
  if (model == nullptr) throw Error(ErrorKind::internal, {files.fit().string(), "a fit that is no model", "a model"});
  draw_lobe(*samples.dataset, *model, files.picture());

  const double total_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (console.json) {
    console.print_json(
        Json::object({{"context", context({hash_in_background(files.plan()), hash_in_background(files.bench())}, bench.seed, true)},
                      {"folder", folder},
                      {"samples", static_cast<std::int64_t>(samples.dataset->size())},
                      {"bench_s", swept.bench_s},
                      {"total_s", total_s},
                      {"fit", fit_document(fit, samples.masked, timings, Json::object())},
                      {"checks", checks_document(checks, Json::object())}}));
    return 0;
  }
  console.print(fmt::format("\nMeasured {} directions in {} of bench time ({:.1f} s here), on a simulated bench.", samples.dataset->size(),
                            duration_text(swept.bench_s), total_s));
  const auto* truth = dynamic_cast<const AnalyticBrdf*>(sample.get());
  for (const std::string& line : fit_lines(fit, samples.masked)) console.print(line);
  if (truth != nullptr && truth->model().name == fit.model && !fit.values.empty())
    console.print(fmt::format("  against the truth: rho_d {}, rho_s {}, s {}", relative_error_text(fit.values[0][0], truth->values()[0][0]),
                              relative_error_text(fit.values[0][1], truth->values()[0][1]),
                              relative_error_text(fit.values[0][2], truth->values()[0][2])));
  console.print("Checks of the samples");
  for (const std::string& line : check_lines(checks)) console.print(line);
  console.print(fmt::format("\nIn {}:", folder));
  const std::pair<fs::path, const char*> made[] = {{files.run(), "every reading, raw"},
                                                   {files.samples(), "samples with uncertainty"},
                                                   {files.table(), "the same as a table, for image viewers too"},
                                                   {files.fit(), "the fitted model"},
                                                   {files.checks(), "the verdicts"},
                                                   {files.rgl(), "the fit for Mitsuba 3 and Falcor; material.xml: a scene"},
                                                   {files.merl(), "the fit on MERL's grid"},
                                                   {files.picture(), "measured points over the fitted lobe"}};
  for (const auto& [path, what] : made) console.print(fmt::format("  {:<24} {}", fs::relative(path, folder).string(), what));
  return 0;
}

}  // namespace gonio::tools
