// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/polar_block.hpp"

#include <cmath>

namespace gonio::tabulated {

void append_samples(const PolarBlock& block, Dataset& out) {
  const std::size_t azimuths = block.phi_deg.size();
  out.f.resize(block.values.size());
  for (std::size_t t = 0; t < block.theta_deg.size(); ++t)
    for (std::size_t p = 0; p < azimuths; ++p) {
      const double theta = block.theta_deg[t];
      if (out.side == Side::reflection ? theta > 90 : theta < 90) {
        ++out.masked.below_horizon;
        continue;
      }
      const bool same_direction = theta == 0 || theta == 180 || (p + 1 == azimuths && block.phi_deg[p] - block.phi_deg[0] == 360);
      bool seen = p > 0 && same_direction;
      for (const auto& column : block.values) seen = seen && column[t * azimuths + p] == column[t * azimuths];
      if (seen) continue;
      const Angle phi = block.phi_of_first_axis + degrees(block.phi_deg[p]);
      out.angles.push_back({block.theta_i, block.phi_i, degrees(theta), phi.degrees() < 360 ? phi : phi - degrees(360)});
      for (std::size_t c = 0; c < block.values.size(); ++c) out.f[c].push_back(block.values[c][t * azimuths + p]);
    }
}

}  // namespace gonio::tabulated
