// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/dataset.hpp"

#include <cmath>
#include <limits>

#include "brdf/error.hpp"

namespace gonio {

double Dataset::total_uncertainty(std::size_t channel, std::size_t sample) const {
  if (u.empty()) return std::numeric_limits<double>::quiet_NaN();
  double relative = 0;
  for (const CorrelatedComponent& component : correlated) {
    const double c = component.sensitivity.empty() ? 1.0 : component.sensitivity[sample];
    relative = std::hypot(relative, c * component.u);
  }
  return std::hypot(u[channel][sample], f[channel][sample] * relative);
}

void Dataset::require_consistent() const {
  std::vector<Fault> faults;
  const auto column = [&](const std::string& name, std::size_t length) {
    if (length != size()) faults.push_back({name, std::to_string(length) + " values", std::to_string(size()) + ", one per sample"});
  };
  if (f.size() != channels.size()) faults.push_back({"f", std::to_string(f.size()) + " channels", std::to_string(channels.size())});
  if (!u.empty() && u.size() != channels.size())
    faults.push_back({"u", std::to_string(u.size()) + " channels", std::to_string(channels.size()) + " or none"});
  for (const auto& values : f) column("f", values.size());
  for (const auto& values : u) {
    column("u", values.size());
    for (const double value : values)
      if (value <= 0) {
        faults.push_back({"u", "a standard uncertainty of zero or below", "a positive number, or NaN for unknown"});
        break;
      }
  }
  for (const auto& component : correlated)
    if (!component.sensitivity.empty()) column("c_" + component.name, component.sensitivity.size());
  for (const auto& [name, values] : extra) column(name, values.size());
  if (!faults.empty()) throw Error(ErrorKind::internal, "a data set is inconsistent", faults);
}

}  // namespace gonio
