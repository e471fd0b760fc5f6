// SPDX-License-Identifier: BSD-3-Clause
#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {

const std::vector<Topic>& topics() {
  static const std::vector<Topic> list{
      {"albedo", "directional albedo of a lobe: closed form, quadratures, Monte Carlo", measure_albedo},
      {"export", "a BRDF in every file format: bytes against what a reader of the file gets", measure_export},
      {"fit", "parameters from all samples, collapsed rows or a part of the samples", measure_fit},
      {"precision", "float against double, naive against stable kernels, at the hard places", measure_precision},
      {"table", "look-up tables: resolution, parameterisation, interpolation and storage", measure_table},
  };
  return list;
}

}  // namespace gonio::tools::tradeoff
