// SPDX-License-Identifier: BSD-3-Clause
// A table of zenith angles by azimuths for one incidence, as many text formats hold it.
#pragma once

#include <vector>

#include "brdf/dataset.hpp"

namespace gonio::tabulated {

struct PolarBlock {
  Angle theta_i, phi_i;
  Angle phi_of_first_axis;  ///< azimuth of wo where the block's azimuth is 0
  std::vector<double> theta_deg, phi_deg;
  std::vector<std::vector<double>> values;  ///< [channel][theta · azimuths + azimuth] 1/sr

  double& value(std::size_t channel, std::size_t theta, std::size_t azimuth) { return values[channel][theta * phi_deg.size() + azimuth]; }
};

/// Adds the nodes on the side of `out` and counts the others as masked; theta counts from +z. A direction that a block holds twice with
/// equal values (the normal, azimuths 0 and 360°) becomes one sample.
void append_samples(const PolarBlock& block, Dataset& out);

}  // namespace gonio::tabulated
