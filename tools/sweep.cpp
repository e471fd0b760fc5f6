// SPDX-License-Identifier: BSD-3-Clause
// gonio sweep: measure a plan on a bench.
#include "acquisition/sweep.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "tools/bench_source.hpp"
#include "tools/measure.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

using namespace gonio::acquisition;

/// HOST:PORT or PORT.
Endpoint endpoint_from(const std::string& text, const std::string& flag) {
  Endpoint endpoint;
  std::string port = text;
  if (const auto colon = text.rfind(':'); colon != std::string::npos) {
    endpoint.host = text.substr(0, colon);
    port = text.substr(colon + 1);
  }
  const double number = number_from(port, flag);
  if (!(number >= 1 && number <= 65535) || number != static_cast<int>(number))
    throw Error(ErrorKind::usage, {flag, "'" + text + "'", "HOST:PORT with a port from 1 to 65535"});
  endpoint.port = static_cast<int>(number);
  return endpoint;
}

/// The run must have been started with this plan and this bench.
void require_same(const Run& run, const Bench& bench, const PlanRequest& request, const std::string& path) {
  std::vector<Fault> faults;
  if (run.bench().sha256 != bench.sha256)
    faults.push_back({path, "a run on another bench file (sha256 " + run.bench().sha256 + ")", "sha256 " + bench.sha256});
  if (run.request().sha256 != request.sha256)
    faults.push_back({path, "a run of another plan file (sha256 " + run.request().sha256 + ")", "sha256 " + request.sha256});
  if (!faults.empty()) throw Error(ErrorKind::input, "this run cannot be resumed with these files", faults);
}

}  // namespace

int sweep_verb(const Arguments& arguments, Console& console) {
  CLI::App app("Measures a plan: dark, reference and sample readings, each committed to the run file as it is taken.", "sweep");
  PlanSource source;
  std::string out, sample, modbus, scpi, clock = "bench";
  std::vector<std::string> parameters;
  std::optional<std::uint64_t> seed;
  bool resume = false;
  source.add_to(app);
  app.add_option("--out", out, "Run file (.gonio)")->required();
  app.add_flag("--resume", resume, "Go on with the run file if it exists");
  app.add_option("--sample", sample, "Simulated bench: a model's name or a BRDF file instead of the bench file's sample");
  app.add_option("--param", parameters, "NAME=VALUE of the sample's model")->take_all();
  app.add_option("--seed", seed, "Simulated bench: another seed than the bench file's");
  app.add_option("--modbus", modbus, "HOST:PORT of the drives instead of the bench file's");
  app.add_option("--scpi", scpi, "HOST:PORT of the detector instead of the bench file's");
  app.add_option("--clock", clock, "Embedded bench: real or virtual (default)")->check(CLI::IsMember({"bench", "real", "virtual"}));
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  Bench bench = bench_with_seed(source.bench, seed);
  if (!modbus.empty()) bench.modbus = endpoint_from(modbus, "--modbus");
  if (!scpi.empty()) bench.scpi = endpoint_from(scpi, "--scpi");
  const PlanRequest request = source.request();
  const SweepPlan plan = make_plan(request, bench);
  source.require_reachable(plan);
  std::shared_ptr<const Brdf> brdf;
  if (is_embedded(bench)) brdf = simulated_sample(bench, source.bench, sample, parameters);
  for (const std::string& line : plan_lines(plan, bench)) console.note(line);

  // A sweep that was stopped before its run file stood is begun anew.
  const bool exists = resume && std::filesystem::exists(out);
  if (exists) require_same(Run::open(out), bench, request, out);
  Run run = exists ? Run::open(out, true) : Run::create(out, bench, request, plan);
  const ClockChoice choice = clock == "real" ? ClockChoice::real : clock == "virtual" ? ClockChoice::virtual_time : ClockChoice::bench;
  const SweepResult result = measure(run, bench, brdf, choice, console);

  if (console.json) {
    const auto count = [](std::size_t n) { return Json(static_cast<std::int64_t>(n)); };
    console.print_json(Json::object(
        {{"context", context({hash_in_background(source.plan), hash_in_background(source.bench)}, bench.seed, bench.is_simulated)},
         {"run", out},
         {"measured", count(result.measured)},
         {"skipped", count(result.skipped)},
         {"masked", count(result.masked)},
         {"retried", count(result.retried)},
         {"bench_s", result.bench_s}}));
    return 0;
  }
  console.print(fmt::format("{}: {} steps measured, {} had been measured before, {} masked, {} readings retried; bench time {}", out,
                            result.measured, result.skipped, result.masked, result.retried, duration_text(result.bench_s)));
  return 0;
}

}  // namespace gonio::tools
