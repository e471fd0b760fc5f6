// SPDX-License-Identifier: BSD-3-Clause
// Reading a plan file.
#include <fmt/format.h>

#include <cmath>

#include "acquisition/plan.hpp"
#include "brdf/error.hpp"
#include "data-schemas/document.hpp"

namespace gonio::acquisition {
namespace {

constexpr double max_points = 1e6;        // of one plan: a year of readings, and a file that still fits in memory
constexpr double last_step_slack = 1e-6;  // of a step: {0, 0.3, 0.1} includes 0.3 although 3 · 0.1 is more than 0.3 in binary

struct Places {
  std::string source;
  std::vector<Fault> faults;

  void add(const std::string& pointer, std::string found, std::string wanted) {
    faults.push_back({source + "#" + pointer, std::move(found), std::move(wanted)});
  }
};

/// A list of angles, or from, from + step, ... up to `to`.
std::vector<double> angles(const Json& json, const std::string& pointer, double largest, Places& places) {
  std::vector<double> out;
  if (json.is_array()) {
    for (const Json& angle : json.elements()) out.push_back(angle.number());
    return out;
  }
  const double from = json.at("from").number(), to = json.at("to").number(), step = json.at("step").number();
  const double steps = std::floor((to - from) / step + last_step_slack);
  if (from > to) places.add(pointer + "/from", fmt::format("{:g}", from), fmt::format("not more than `to`, {:g}", to));
  if (std::abs(from) > largest || std::abs(to) > largest)
    places.add(pointer, fmt::format("{:g} to {:g}", from, to), fmt::format("angles from {:g} to {:g}", -largest, largest));
  if (steps >= max_points) {
    places.add(pointer + "/step", fmt::format("{:g}, {:.0f} angles", step, steps + 1), fmt::format("at most {:.0f} angles", max_points));
    return out;
  }
  for (double k = 0; k <= steps; ++k) out.push_back(from + k * step);
  return out;
}

}  // namespace

PlanRequest plan_from(const Json& document, const std::string& source) {
  const std::string refused = "the plan cannot be used";
  if (std::vector<Fault> faults = faults_of(document, Schema::plan, source); !faults.empty())
    throw Error(ErrorKind::input, refused, std::move(faults));
  Places places{source, {}};
  PlanRequest r;
  r.name = document.at("name").string();
  const Json &incident = document.at("incident"), &outgoing = document.at("outgoing");
  r.theta_i_deg = angles(incident.at("theta_deg"), "/incident/theta_deg", 180, places);
  r.phi_i_deg = angles(incident.at("phi_deg"), "/incident/phi_deg", 360, places);
  r.theta_o_deg = angles(outgoing.at("theta_deg"), "/outgoing/theta_deg", 180, places);
  r.phi_o_deg = angles(outgoing.at("phi_deg"), "/outgoing/phi_deg", 360, places);
  if (const Json& density = document.get("density"); !density.is_null()) {
    r.density_points = static_cast<int>(density.at("points").number());
    r.density_width_deg = density.at("width_deg").number();
  }
  r.reciprocity_pairs = static_cast<int>(document.number_or("reciprocity_pairs", 0));
  r.rotations = static_cast<int>(document.number_or("rotations", 1));
  if (const Json& exposure = document.get("exposure_s"); !exposure.is_null()) r.exposure_s = exposure.number();
  r.seed = static_cast<std::uint64_t>(document.number_or("seed", 1));
  const auto count = [](const std::vector<double>& list) { return static_cast<double>(list.size()); };
  const double points =
      (count(r.theta_i_deg) * count(r.phi_i_deg) * (count(r.theta_o_deg) * count(r.phi_o_deg) + r.density_points) + r.reciprocity_pairs) *
      r.rotations;
  if (points > max_points) places.add("", fmt::format("{:.0f} points", points), fmt::format("at most {:.0f}", max_points));
  if (!places.faults.empty()) throw Error(ErrorKind::input, refused, std::move(places.faults));
  r.document = document;
  r.sha256 = sha256(document.dump());
  return r;
}

PlanRequest load_plan(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  PlanRequest request = plan_from(parse_json(text, path.string()), path.string());
  request.sha256 = sha256(text);
  return request;
}

}  // namespace gonio::acquisition
