// SPDX-License-Identifier: BSD-3-Clause
#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {

const std::vector<Topic>& topics() {
  static const std::vector<Topic> list{
      {"albedo", "directional albedo of a lobe: closed form, quadratures, Monte Carlo", measure_albedo},
      {"fit", "parameters from all samples, collapsed rows or a part of the samples", measure_fit},
      {"precision", "float against double, naive against stable kernels, at the hard places", measure_precision},
  };
  return list;
}

}  // namespace gonio::tools::tradeoff
