// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/coated_diffuse.hpp"

namespace gonio::tabulated::targets::coated_diffuse {

std::vector<FormulaParameter> slots(std::string_view albedo_name, std::string_view alpha_name, std::string_view index_name,
                                    std::string_view scale_name) {
  std::vector<FormulaParameter> out{{albedo_name, 0, 1, true}, {alpha_name, 1e-3, 1, false}, {index_name, 1.02, 4, false}};
  if (!scale_name.empty()) out.push_back({scale_name, 0, 1, true});
  return out;
}

std::vector<double> converted(const LobeSummary& s, std::size_t c) { return {s.rho_d[c], mean_width(s), index_of(mean(s.f0)), s.f90[c]}; }

}  // namespace gonio::tabulated::targets::coated_diffuse
