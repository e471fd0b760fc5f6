// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/starts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gonio::tabulated::targets {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double mean_width(const LobeSummary& summary) { return std::sqrt(summary.alpha_x * summary.alpha_y); }
double aspect_of(const LobeSummary& summary) { return std::sqrt(summary.alpha_y / summary.alpha_x); }

bool is_metal(const LobeSummary& summary) {
  constexpr double brightest_dielectric = 0.17;  // diamond
  return mean(summary.f0) > brightest_dielectric;
}

std::vector<ChannelValues> converted_starts(const LobeSummary& summary, const std::vector<FormulaParameter>& parameters, bool both,
                                            std::vector<double> (*convert)(const LobeSummary&, bool, std::size_t)) {
  std::vector<ChannelValues> out;
  for (const double wider : {1.0, 0.6, 1.6})
    for (const bool other : {false, true}) {
      if (other && !both) continue;
      LobeSummary changed = summary;
      changed.alpha_x *= wider, changed.alpha_y *= wider;
      ChannelValues values;
      for (std::size_t c = 0; c < summary.rho_d.size(); ++c) {
        values.push_back(convert(changed, is_metal(summary) != other, c));
        for (std::size_t p = 0; p < parameters.size(); ++p)
          values[c][p] = std::clamp(values[c][p], parameters[p].lower, parameters[p].upper);
      }
      out.push_back(std::move(values));
    }
  return out;
}

double burley_anisotropic(double aspect) {
  const double ratio = std::min(aspect, 1 / aspect), amount = (1 - ratio * ratio) / 0.9;
  return aspect > 1 ? -amount : amount;
}

}  // namespace gonio::tabulated::targets
