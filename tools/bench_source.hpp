// SPDX-License-Identifier: BSD-3-Clause
// The flags that name a plan and a bench, and the sample of a simulated one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/plan.hpp"
#include "brdf/brdf.hpp"
#include "tools/console.hpp"

namespace gonio::tools {

/// PLAN, --bench and the flags that change a plan.
struct PlanSource {
  std::string plan, bench;
  int reciprocity_pairs = -1, rotations = -1;
  bool skip_unreachable = false;

  void add_to(CLI::App& app);
  /// The plan file with the flags applied.
  acquisition::PlanRequest request() const;
  /// Error(limit) naming every unreachable point, unless --skip-unreachable.
  void require_reachable(const acquisition::SweepPlan& plan) const;
};

/// The bench of a file, with the seed of its simulation replaced if one is given.
acquisition::Bench bench_with_seed(const std::filesystem::path& path, std::optional<std::uint64_t> seed);

/// A plan for people: counts by state and reason, predicted time, travel over its bound.
std::vector<std::string> plan_lines(const acquisition::SweepPlan& plan, const acquisition::Bench& bench);

/// "2 h 31 min", "4.2 s".
std::string duration_text(double seconds);

/// The sample that lies on a simulated bench: `--sample SOURCE --param NAME=VALUE`, else the bench file's own. A file's path is relative
/// to the bench file's folder. Error(usage) if there is neither.
std::shared_ptr<const Brdf> simulated_sample(const acquisition::Bench& bench, const std::string& bench_path, const std::string& sample,
                                             const std::vector<std::string>& parameters);

}  // namespace gonio::tools
