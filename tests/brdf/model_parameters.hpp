// SPDX-License-Identifier: BSD-3-Clause
// Parameter values for tests that run over the list of models.
#pragma once

#include <cmath>
#include <vector>

#include "brdf/model_info.hpp"

namespace gonio::test {

/// The example values of a model, in table order.
inline std::vector<double> example_values(const ModelInfo& info) {
  std::vector<double> out;
  for (const Parameter& p : info.parameters) out.push_back(p.example);
  return out;
}

/// The example values, then for every nonlinear parameter the same with that one at its bounds, at the ends of the scan and at
/// `between` places of the scan.
inline std::vector<std::vector<double>> parameter_settings(const ModelInfo& info, int between = 2) {
  std::vector<std::vector<double>> out{example_values(info)};
  for (std::size_t k = info.linear_count; k < info.parameters.size(); ++k) {
    const Parameter& p = info.parameters[k];
    std::vector<double> places{p.lower, p.scan_low, p.scan_high, p.upper};
    for (int j = 1; j <= between; ++j) {
      const double part = static_cast<double>(j) / (between + 1);
      places.push_back(p.axis == Parameter::Axis::logarithmic ? p.scan_low * std::pow(p.scan_high / p.scan_low, part)
                                                              : p.scan_low + part * (p.scan_high - p.scan_low));
    }
    for (const double place : places) {
      out.push_back(out.front());
      out.back()[k] = place;
    }
  }
  return out;
}

}  // namespace gonio::test
