// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/conductor_mix.hpp"

#include "tabulated/targets/starts.hpp"

namespace gonio::tabulated::targets::conductor_mix {
namespace {

/// As much of the conductor as the diffuse part leaves room for.
std::vector<double> convert(const LobeSummary& s, bool, std::size_t c) {
  const double w = std::clamp(1 - *std::max_element(s.rho_d.begin(), s.rho_d.end()), 0.05, 0.99);
  return {s.rho_d[c] / (1 - w), index_of(s.f0[c] / w), 0.01, mean_width(s), aspect_of(s), w};
}

}  // namespace

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{
      {"reflectance", 0, 1, true}, {"eta", 0.05, 40, true},       {"k", 0, 40, true},
      {"alpha", 1e-3, 1, false},   {"aspect", 0.1, 10, false, 1}, {"weight", 1e-3, 1 - 1e-3, false}};
  return list;
}

std::vector<ChannelValues> starts(const LobeSummary& s) {
  std::vector<ChannelValues> out = converted_starts(s, slots(), false, convert);
  // The same reflectance at the normal from absorption instead of a high index.
  for (std::size_t n = out.size(), j = 0; j < n; ++j) {
    ChannelValues metal = out[j];
    for (auto& set : metal) {
      const double f0 = f0_of(set[eta]);
      set[eta] = 1, set[k] = 2 * std::sqrt(f0 / (1 - f0));
    }
    out.push_back(std::move(metal));
  }
  return out;
}

}  // namespace gonio::tabulated::targets::conductor_mix
