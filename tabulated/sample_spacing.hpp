// SPDX-License-Identifier: BSD-3-Clause
// How far apart samples lie: along one incidence and from one incidence to the next.
#pragma once

#include <cstddef>
#include <vector>

#include "tabulated/pair_coordinates.hpp"

namespace gonio::tabulated {

/// Typical distances in the coordinates of `pair_point`, and the incidences that samples share.
struct SampleSpacing {
  double s = 0, t = 0;                 ///< step to the next sample of the same incidence; step to the next incidence
  std::size_t incidences = 0;          ///< distinct t
  bool gridded = false;                ///< many samples share an incidence; else s and t are the same
  std::vector<std::size_t> incidence;  ///< of every sample, in the order of its points
};

/// Incidences closer than half a degree are one. Of scattered samples, where hardly any two share one, both distances are that to the
/// nearest sample.
SampleSpacing sample_spacing(const std::vector<PairPoint>& samples);

}  // namespace gonio::tabulated
