// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bench_source.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include <fmt/format.h>

#include "tabulated/open.hpp"
#include "tools/brdf_source.hpp"

namespace gonio::tools {

using namespace gonio::acquisition;

void PlanSource::add_to(CLI::App& app) {
  app.add_option("PLAN", plan, "Plan file (JSON)")->required();
  app.add_option("--bench", bench, "Bench file (JSON)")->required();
  app.add_option("--reciprocity-pairs", reciprocity_pairs, "Add the exchanged pair of that many points")->check(CLI::NonNegativeNumber);
  app.add_option("--rotations", rotations, "Measure every point at that many turns of the sample")->check(CLI::PositiveNumber);
  app.add_flag("--skip-unreachable", skip_unreachable, "Go on without the points the bench cannot reach");
}

PlanRequest PlanSource::request() const {
  PlanRequest request = load_plan(plan);
  if (reciprocity_pairs < 0 && rotations < 0) return request;
  // The flags become part of the document, so that the run file holds what was asked for.
  Json document = request.document;
  if (reciprocity_pairs >= 0) document.set("reciprocity_pairs", reciprocity_pairs);
  if (rotations > 0) document.set("rotations", rotations);
  return plan_from(document, plan);
}

void PlanSource::require_reachable(const SweepPlan& plan_) const {
  if (skip_unreachable) return;
  constexpr std::size_t most = 20;
  std::vector<Fault> faults;
  std::size_t count = 0;
  for (const PlanStep& step : plan_.steps) {
    if (step.state != StepState::unreachable) continue;
    if (++count <= most)
      faults.push_back({fmt::format("point ({:g}, {:g}) -> ({:g}, {:g})", step.pose.theta_i.degrees(), step.pose.phi_i.degrees(),
                                    step.pose.theta_o.degrees(), step.pose.phi_o.degrees()),
                        step.reason, "a pose within the limits, or --skip-unreachable"});
  }
  if (count == 0) return;
  if (count > most)
    faults.push_back({plan, fmt::format("{} more unreachable points", count - most), "see gonio plan --skip-unreachable --list"});
  throw Error(ErrorKind::limit, fmt::format("{} points of the plan cannot be reached; nothing has moved", count), faults);
}

Bench bench_with_seed(const std::filesystem::path& path, std::optional<std::uint64_t> seed) {
  Bench bench = load_bench(path);
  if (!seed) return bench;
  if (!bench.is_simulated)
    throw Error(ErrorKind::usage, {"--seed", "a bench that is not simulated", "a bench file with a `simulated` part"});
  Json document = bench.document, simulated = document.at("simulated");
  simulated.set("seed", *seed);
  document.set("simulated", simulated);
  return bench_from(document, path.parent_path(), path.string());
}

std::vector<std::string> plan_lines(const SweepPlan& plan, const Bench& bench) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} steps on bench '{}': {} samples, {} dark, {} reference readings", plan.steps.size(), bench.name,
                              plan.count(StepKind::sample, StepState::ok), plan.count(StepKind::dark, StepState::ok),
                              plan.count(StepKind::reference, StepState::ok)));
  // Points by what is wrong with them, with the first one's own words.
  struct Group {
    std::size_t count = 0;
    std::string example;
  };
  std::map<std::string, Group> groups;
  for (const PlanStep& step : plan.steps) {
    if (step.state == StepState::ok) continue;
    Group& group = groups[fmt::format("{}: {}", name(step.state), step.reason.substr(0, step.reason.find(':')))];
    if (group.count++ == 0) group.example = step.reason.substr(std::min(step.reason.size(), step.reason.find(':')));
  }
  for (const auto& [what, group] : groups)
    lines.push_back(fmt::format("  {:5} {}{}", group.count, what, group.count == 1 ? group.example : " (--list says why for each)"));
  lines.push_back(fmt::format("  predicted {}; travel {:.0f}° of the slowest axis, {:.2f} times the lower bound",
                              duration_text(plan.predicted_s), plan.travel_deg,
                              plan.travel_bound_deg > 0 ? plan.travel_deg / plan.travel_bound_deg : 1.0));
  return lines;
}

std::string duration_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto minutes = static_cast<long>(seconds / 60 + 0.5);
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::shared_ptr<const Brdf> simulated_sample(const Bench& bench, const std::string& bench_path, const std::string& sample,
                                             const std::vector<std::string>& parameters) {
  tabulated::Opened opened;
  std::string what = sample;
  if (!sample.empty()) {
    opened = open_source(sample, parameters, {});
  } else if (!parameters.empty()) {
    throw Error(ErrorKind::usage, {"--param", "parameters without a sample", "--sample MODEL"});
  } else if (!bench.simulated.sample) {
    throw Error(ErrorKind::usage, {bench_path, "a simulated bench without a sample", "--sample SOURCE, or `sample` in the bench file"});
  } else if (!bench.simulated.sample->file.empty()) {
    what = bench.simulated.sample->file.string();
    opened = tabulated::open_brdf(bench.simulated.sample->file);
  } else {
    what = bench.simulated.sample->model;
    std::vector<std::string> own;
    for (const auto& [name, value] : bench.simulated.sample->parameters) own.push_back(fmt::format("{}={}", name, value));
    opened = model_source(what, own);
  }
  if (!opened.brdf) throw Error(ErrorKind::input, {what, opened.format + " that cannot be evaluated", "a model or a table"});
  return opened.brdf;
}

}  // namespace gonio::tools
