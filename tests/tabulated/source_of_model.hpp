// SPDX-License-Identifier: BSD-3-Clause
// A model as the source of a writer, and how far what was written and read again is from it.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/open.hpp"
#include "tests/random_directions.hpp"

namespace gonio::test {

inline tabulated::Opened source_of_model(const std::string& model, Channels channels, std::vector<std::vector<double>> values) {
  tabulated::Opened out;
  out.format = "model";
  out.brdf = std::make_shared<const AnalyticBrdf>(model, std::move(channels), std::move(values));
  return out;
}

/// Mean of |table / model - 1| over pairs of directions up to 80°, first channel; unknown values count as 1.
inline double mean_error(const Brdf& table, const Brdf& model) {
  Random random(seed);
  double sum = 0;
  int count = 0;
  for (int k = 0; k < 20000; ++k) {
    const Direction wi = upper_direction(random), wo = upper_direction(random);
    if (wi.z() < 0.17 || wo.z() < 0.17) continue;
    const double ratio = table.eval(wi, wo)[0] / model.eval(wi, wo)[0];
    sum += std::isnan(ratio) ? 1 : std::fabs(ratio - 1);
    ++count;
  }
  return sum / count;
}

}  // namespace gonio::test
