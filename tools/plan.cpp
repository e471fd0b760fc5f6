// SPDX-License-Identifier: BSD-3-Clause
// gonio plan: what a sweep would do. Moves nothing.
#include "acquisition/plan.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "tools/bench_source.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

using namespace gonio::acquisition;

Json step_document(const PlanStep& step) {
  Json axes = Json::array();
  for (const double angle : step.axes) axes.push_back(angle);
  return Json::object({{"step", step.number},
                       {"kind", name(step.kind)},
                       {"theta_i_deg", step.pose.theta_i.degrees()},
                       {"phi_i_deg", step.pose.phi_i.degrees()},
                       {"theta_o_deg", step.pose.theta_o.degrees()},
                       {"phi_o_deg", step.pose.phi_o.degrees()},
                       {"axes_deg", axes},
                       {"exposure_s", step.exposure_s},
                       {"state", name(step.state)},
                       {"reason", step.reason.empty() ? Json() : Json(step.reason)},
                       {"rotation_deg", step.rotation_deg},
                       {"partner", step.partner < 0 ? Json() : Json(step.partner)}});
}

}  // namespace

int plan_verb(const Arguments& arguments, Console& console) {
  CLI::App app("Reachability by point and reason, order, predicted time, travel over its lower bound. Moves nothing.", "plan");
  PlanSource source;
  bool list = false;
  source.add_to(app);
  app.add_flag("--list", list, "Every step, one line each");
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const Bench bench = load_bench(source.bench);
  const PlanRequest request = source.request();
  const SweepPlan plan = make_plan(request, bench);
  source.require_reachable(plan);

  if (console.json) {
    Json steps = Json::array();
    for (const PlanStep& step : plan.steps) steps.push_back(step_document(step));
    console.print_json(Json::object(
        {{"context", context({hash_in_background(source.plan), hash_in_background(source.bench)}, request.seed, bench.is_simulated)},
         {"predicted_s", plan.predicted_s},
         {"travel_deg", plan.travel_deg},
         {"travel_bound_deg", plan.travel_bound_deg},
         {"steps", steps}}));
    return 0;
  }
  for (const std::string& line : plan_lines(plan, bench)) console.print(line);
  if (list)
    for (const PlanStep& step : plan.steps)
      console.print(fmt::format("{:6} {:<9} ({:g}, {:g}) -> ({:g}, {:g})  {}{}", step.number, name(step.kind), step.pose.theta_i.degrees(),
                                step.pose.phi_i.degrees(), step.pose.theta_o.degrees(), step.pose.phi_o.degrees(), name(step.state),
                                step.reason.empty() ? "" : ": " + step.reason));
  return 0;
}

}  // namespace gonio::tools
