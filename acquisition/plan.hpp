// SPDX-License-Identifier: BSD-3-Clause
// A sweep as a value: printable, drawable, checked before anything moves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/kinematics.hpp"
#include "acquisition/pose.hpp"
#include "data-schemas/json.hpp"

namespace gonio::acquisition {

enum class StepKind { sample, dark, reference };
enum class StepState { ok, masked, unreachable };
const char* name(StepKind kind) noexcept;
const char* name(StepState state) noexcept;
/// Readings taken at a step of this kind: the bench says how many for dark and reference steps, one for the sample.
int readings_at(StepKind kind, const Bench& bench) noexcept;

struct PlanStep {
  std::int64_t number = 0;  ///< stable identity of the step in the run file
  StepKind kind = StepKind::sample;
  Pose pose;
  AxisAngles axes;          ///< commanded; empty unless ok. Dark steps carry those of their neighbour: nothing moves for them
  double exposure_s = 0.1;  ///< of each reading
  StepState state = StepState::ok;
  std::string reason;         ///< why masked or unreachable
  double rotation_deg = 0;    ///< rotation of the sample this point belongs to (`--rotations`)
  std::int64_t partner = -1;  ///< step number of its reciprocal partner, or -1
};

/// What the plan file asks for. Points = (grid ∪ density ∪ reciprocal partners) × rotations.
struct PlanRequest {
  std::string name;
  std::vector<double> theta_i_deg, phi_i_deg;
  std::vector<double> theta_o_deg, phi_o_deg;  ///< grid of outgoing directions; phi_o relative to phi_i: 180° is the specular side
  int density_points = 0;                      ///< per incidence, around the specular direction
  double density_width_deg = 15;               ///< half of the density points lie within this angle of the specular direction
  int reciprocity_pairs = 0;                   ///< partners added to that many points, per --reciprocity-pairs
  int rotations = 1;                           ///< K: every point at K turns of the sample, k · 360°/K added to phi_i and phi_o
  std::optional<double> exposure_s;            ///< of sample readings; none: the bench's
  std::uint64_t seed = 1;

  Json document;
  std::string sha256;
};

/// Reads and validates a plan file. Error(input) with all faults.
PlanRequest load_plan(const std::filesystem::path& path);
/// From a document; validates it too. `source` names the document in faults.
PlanRequest plan_from(const Json& document, const std::string& source = "plan");

/// The ordered sweep: dark and reference steps inserted by predicted bench time, sample points ordered to keep travel short.
struct SweepPlan {
  std::vector<PlanStep> steps;                  ///< in the order they are measured; masked and unreachable points included
  double predicted_s = 0;                       ///< motion + settling + exposure
  double travel_deg = 0, travel_bound_deg = 0;  ///< largest angle of any axis per move between sample points, summed; a lower bound of it
  double motion_s = 0, motion_bound_s = 0;      ///< the same moves in time, which is what the order keeps short; a lower bound of it
  std::size_t count(StepKind kind, StepState state) const;
};

SweepPlan make_plan(const PlanRequest& request, const Bench& bench);

/// Seconds of a move with trapezoidal speed profiles, all axes starting together.
double move_time_s(const AxisAngles& from, const AxisAngles& to, const Bench& bench);

}  // namespace gonio::acquisition
