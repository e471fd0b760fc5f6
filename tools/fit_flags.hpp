// SPDX-License-Identifier: BSD-3-Clause
// The flags that say what is fitted and how, the same for one file, many, and shards.
#pragma once

#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "tools/brdf_source.hpp"

namespace gonio::tools {

/// A fit as the flags ask for it.
struct FitRequest {
  tabulated::ReadOptions read;
  fitting::FitOptions fit;
  /// Every flag that shapes the result, by its name without dashes; `model` always. The same request on the same bytes by
  /// the same version gives the same parameters.
  Json options;
};

struct FitFlags {
  std::string metric, weights, robust, nuisance;  ///< empty: the default of FitOptions
  std::vector<std::string> fixed, bounds;
  fitting::FitOptions fit;
  ReadFlags read;

  void add_to(CLI::App& app);
  /// Error(usage) for a value that no flag takes, or for an unknown model.
  FitRequest request() const;
  /// The same where --model names several, which have been looked up.
  FitRequest request(const std::vector<std::string>& models) const;
};

}  // namespace gonio::tools
