// SPDX-License-Identifier: BSD-3-Clause
// gonio reduce: raw readings -> samples with uncertainty.
#include "acquisition/reduce.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "tools/output.hpp"
#include "tools/reduced_run.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {

tabulated::Opened reduced_run(const std::filesystem::path& path) {
  const acquisition::Run run = acquisition::Run::open(path);
  auto dataset = std::make_shared<Dataset>(acquisition::reduce(run));
  dataset->provenance["source"] = path.filename().string();
  tabulated::Opened out;
  out.format = "run";
  out.masked = dataset->masked;
  out.simulated = dataset->simulated;
  out.observations = observe(dataset);
  out.dataset = dataset;
  return out;
}

namespace {

/// A shared component with what it does to a sample: the median over samples where that differs.
std::string component_line(const CorrelatedComponent& component) {
  if (component.sensitivity.empty()) return fmt::format("  shared by all samples: {} {:.3g} %", component.name, 100 * component.u);
  std::vector<double> effects;
  for (const double c : component.sensitivity) effects.push_back(std::fabs(c * component.u));
  std::nth_element(effects.begin(), effects.begin() + static_cast<std::ptrdiff_t>(effects.size() / 2), effects.end());
  const double largest = *std::max_element(effects.begin(), effects.end());
  return fmt::format("  shared by samples: {} {:.2g} % (median), {:.2g} % (most)", component.name, 100 * effects[effects.size() / 2],
                     100 * largest);
}

}  // namespace

int reduce_verb(const Arguments& arguments, Console& console) {
  CLI::App app(
      "Turns raw readings into samples: dark subtracted, drift corrected, relative to the white in its own pose, with independent\n"
      "uncertainty per sample and named shared components.",
      "reduce");
  std::string in, out;
  app.add_option("RUN", in, "Run file (.gonio)")->required();
  app.add_option("--out", out, "Output: NAME.csv or NAME.brdf.exr")->required();
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const tabulated::Format& format = format_of_name(out);
  const tabulated::Opened reduced = reduced_run(in);
  console.note_masked(in, reduced.masked);
  format.write(reduced, out, {});
  if (console.json) {
    Json components = Json::array();
    for (const auto& component : reduced.dataset->correlated)
      components.push_back(Json::object({{"name", component.name}, {"u", component.u}}));
    console.print_json(Json::object({{"context", context({hash_in_background(in)}, std::nullopt, reduced.simulated)},
                                     {"out", out},
                                     {"samples", static_cast<std::int64_t>(reduced.dataset->size())},
                                     {"n_masked", masked_document(reduced.masked)},
                                     {"correlated", components}}));
    return 0;
  }
  console.print(fmt::format("{} -> {}: {} samples", in, out, reduced.dataset->size()));
  for (const auto& component : reduced.dataset->correlated) console.print(component_line(component));
  return 0;
}

}  // namespace gonio::tools
