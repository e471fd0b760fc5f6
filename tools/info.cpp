// SPDX-License-Identifier: BSD-3-Clause
// gonio info: what a file is.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>

#include "acquisition/run.hpp"
#include "data-schemas/document.hpp"
#include "tools/bench_source.hpp"
#include "tools/brdf_source.hpp"
#include "tools/output.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

std::string head_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, {path, "no file that can be read", "a BRDF file, a run, a bench or a plan"});
  std::string head(16, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

Facts facts_of_run(const std::string& path) {
  using namespace acquisition;
  const Run run = Run::open(path);
  const auto steps = run.steps();
  const auto accepted = run.accepted_steps();
  std::map<StepKind, std::size_t> wanted, done;
  for (const PlanStep& step : steps) {
    if (step.state != StepState::ok) continue;
    ++wanted[step.kind];
    done[step.kind] += accepted.contains(step.number) ? 1 : 0;
  }
  Facts facts{{"kind", "run"}, {"bench", run.bench().name}};
  for (const auto& [kind, count] : wanted)
    facts.emplace_back(fmt::format("{} steps", name(kind)), fmt::format("{} of {} measured", done[kind], count));
  facts.emplace_back("readings", std::to_string(run.readings().size()));
  for (const auto& [key, value] : run.meta())
    if (key != "bench" && key != "plan") facts.emplace_back(key, value);  // the whole documents are too long to print
  return facts;
}

/// A bench or plan file, or nothing if the JSON is something else.
Facts facts_of_setup(const std::string& path) {
  std::ifstream file(path);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const Json document = parse_json(text, path);
  if (faults_of(document, Schema::bench, path).empty()) {
    const acquisition::Bench bench = acquisition::load_bench(path);
    Facts facts{{"kind", bench.is_simulated ? "bench (simulated)" : "bench"}, {"name", bench.name}, {"kinematics", bench.kinematics}};
    for (const acquisition::Axis& axis : bench.axes)
      facts.emplace_back("axis " + axis.name, fmt::format("{} to {}°, {}°/s, {}°/s²", axis.lower_deg, axis.upper_deg, axis.speed_deg_per_s,
                                                          axis.acceleration_deg_per_s2));
    facts.emplace_back(
        "reference", fmt::format("{}: {} 1/sr, u {} %", bench.reference.name, bench.reference.f_per_sr, 100 * bench.reference.u_relative));
    return facts;
  }
  if (faults_of(document, Schema::plan, path).empty()) {
    const acquisition::PlanRequest plan = acquisition::load_plan(path);
    return {{"kind", "plan"},
            {"name", plan.name},
            {"incidences", std::to_string(plan.theta_i_deg.size())},
            {"outgoing grid", fmt::format("{} x {}", plan.theta_o_deg.size(), plan.phi_o_deg.size())},
            {"density points", std::to_string(plan.density_points)},
            {"reciprocity pairs", std::to_string(plan.reciprocity_pairs)},
            {"rotations", std::to_string(plan.rotations)}};
  }
  return {};
}

Facts facts_of_brdf(const std::string& path, const ReadFlags& flags) {
  const tabulated::Opened opened = tabulated::open_brdf(path, flags.options());
  Facts facts{{"kind", opened.format}};
  facts.insert(facts.end(), opened.info.begin(), opened.info.end());
  const auto add = [&](const char* key, const std::string& value) {  // formats describe themselves as far as they can
    if (std::none_of(facts.begin(), facts.end(), [&](const auto& fact) { return fact.first == key; })) facts.emplace_back(key, value);
  };
  if (opened.brdf) {
    std::string names;
    for (const Channel& channel : opened.brdf->channels()) names += (names.empty() ? "" : ", ") + channel.name;
    add("channels", names);
  }
  if (opened.masked.total() > 0)
    add("masked", fmt::format("{} ({} nan, {} missing, {} below horizon, {} blocked)", opened.masked.total(), opened.masked.nan,
                              opened.masked.missing, opened.masked.below_horizon, opened.masked.blocked));
  add("side", opened.side == Side::transmission ? "transmission" : "reflection");
  add("simulated", opened.simulated ? "yes" : "no");
  return facts;
}

/// What fits a few lines: documents kept as text, and lists of hundreds of numbers, are for --json.
std::string shortened(const std::string& value) {
  constexpr std::size_t longest = 300;
  if (value.size() <= longest) return value;
  // Not within a letter of several bytes.
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(value[end]) & 0xC0) == 0x80) --end;
  return fmt::format("{} ... ({} bytes, whole with --json)", value.substr(0, end), value.size());
}

}  // namespace

int info_verb(const Arguments& arguments, Console& console) {
  CLI::App app("What a file is: kind, size, channels, angles covered, provenance.", "info");
  std::string path;
  ReadFlags flags;
  app.add_option("FILE", path, "A BRDF file, a run, a bench or a plan")->required();
  flags.add_to(app);
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const std::string head = head_of(path);
  Facts facts;
  if (head.starts_with("SQLite format 3"))
    facts = facts_of_run(path);
  else if (const auto first = head.find_first_not_of(" \t\r\n"); first != std::string::npos && head[first] == '{')
    facts = facts_of_setup(path);
  if (facts.empty()) facts = facts_of_brdf(path, flags);
  facts.emplace_back("size", fmt::format("{} bytes", std::filesystem::file_size(path)));

  if (console.json) {
    Json members = Json::object();
    for (const auto& [key, value] : facts) members.set(key, value);
    console.print_json(
        Json::object({{"context", context({hash_in_background(path)}, std::nullopt, false)}, {"file", path}, {"facts", members}}));
    return 0;
  }
  std::size_t width = 22;
  for (const auto& [key, value] : facts) width = std::max(width, key.size());
  for (const auto& [key, value] : facts) console.print(fmt::format("{:<{}} {}", key, width, shortened(value)));
  return 0;
}

}  // namespace gonio::tools
