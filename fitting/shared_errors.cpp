// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/shared_errors.hpp"

#include <algorithm>
#include <cmath>

namespace gonio::fitting {

SharedErrors shared_errors(const std::vector<CorrelatedComponent>& components, bool held) {
  SharedErrors out;
  for (const CorrelatedComponent& component : components) {
    const auto& c = component.sensitivity;
    if (held || !std::all_of(c.begin(), c.end(), [&](double value) { return value == c.front(); })) {
      out.shape.push_back(component);
      continue;
    }
    const double u = c.empty() ? component.u : std::abs(c.front()) * component.u;
    out.u_scale = std::hypot(out.u_scale.value_or(0), u);
  }
  return out;
}

Change change_by(const Terms& terms, const CorrelatedComponent& component) {
  return [&terms, &component](std::size_t channel, std::size_t row, double) {
    const double cos_i = terms.geometry[row].cos_i, measured = terms.transform.inverse(terms.channel[channel].target[row], cos_i);
    if (measured == 0) return 0.0;
    const double sensitivity = component.sensitivity.empty() ? 1 : component.sensitivity[terms.sample[row]];
    return terms.transform.slope(measured, cos_i) * measured * sensitivity * component.u;
  };
}

std::vector<Change> changes_by(const Terms& terms, const std::vector<CorrelatedComponent>& components) {
  std::vector<Change> out;
  for (const CorrelatedComponent& component : components) out.push_back(change_by(terms, component));
  return out;
}

}  // namespace gonio::fitting
