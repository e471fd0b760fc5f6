// SPDX-License-Identifier: BSD-3-Clause
// Samples of one channel, written down by hand.
#pragma once

#include <utility>
#include <vector>

#include "brdf/dataset.hpp"

namespace gonio::test {

inline Dataset one_channel(std::vector<GonioAngles> angles, std::vector<double> f, std::vector<double> u = {}) {
  Dataset out;
  out.channels = single_channel("value");
  out.angles = std::move(angles);
  out.f = {std::move(f)};
  if (!u.empty()) out.u = {std::move(u)};
  return out;
}

}  // namespace gonio::test
