// SPDX-License-Identifier: BSD-3-Clause
// How samples are divided for cross-validation: by incidence, so that a model has to predict incidences it has not seen.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "brdf/observations.hpp"

namespace gonio::fitting {

struct Folds {
  enum class Over {
    incidences,        ///< every incidence is a fold: leave one out
    incidence_groups,  ///< more incidences than folds: every fold takes one in `count`
    incidence_bins,    ///< scattered incidences: bins of equally many samples
    outgoing_bins,     ///< a single incidence: bins of outgoing zenith angle; says nothing about other incidences
    nothing            ///< too few samples to leave any out
  };
  static constexpr std::uint8_t none = 255;  ///< the fold of what is no measurement

  Over over = Over::nothing;
  std::size_t count = 0;                ///< folds
  std::size_t places = 0;               ///< incidences or bins that the folds are made of
  std::vector<std::uint8_t> of_sample;  ///< one per sample, through all blocks in order
};

/// `leave one incidence out (4 incidences)`, ...
std::string description(const Folds& folds);

/// Incidences are told apart by their zenith angle: values nearer than 0.25° to a neighbour are one incidence (a pose that is read back
/// scatters), unless such a chain is wider than 1°; then incidence is scattered. `max_folds` from 2 to 254.
Folds incidence_folds(const Observations& observations, std::size_t max_folds);

}  // namespace gonio::fitting
