// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/materialx_lobe.hpp"

#include <array>

namespace gonio::tabulated::targets::materialx {

AlbedoParts lobe_albedo(double x, double y) {
  // Coefficients of 1, x, y, xy, x², y², x²y, xy², x²y² in the two numerators and the two denominators
  // (mx_microfacet_specular.glsl, mx_ggx_dir_albedo_analytic).
  constexpr std::array<std::array<double, 9>, 4> c{{{0.1003, -0.6303, 9.748, -2.038, 29.34, -8.245, -26.44, 19.99, -5.448},
                                                    {0.9345, -2.323, 2.229, -3.748, 1.424, -0.7684, 1.436, 0.2913, 0.6286},
                                                    {1.0, -1.765, 8.263, 11.53, 28.96, -7.507, -36.11, 15.86, 33.37},
                                                    {1.0, 0.2281, 15.94, -55.83, 13.08, 41.26, 54.9, 300.2, -285.1}}};
  const std::array<double, 9> terms{1, x, y, x * y, x * x, y * y, x * x * y, x * y * y, x * x * y * y};
  std::array<double, 4> sum{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t k = 0; k < 9; ++k) sum[row] += c[row][k] * terms[k];
  return {std::clamp(sum[0] / sum[2], 0.0, 1.0), std::clamp(sum[1] / sum[3], 0.0, 1.0)};
}

LobeAt lobe_at(const MicrofacetPair& p, const Widths& alpha) {
  const double mean = std::sqrt(alpha.x * alpha.y), m2 = mean * mean;
  const double root_i = std::sqrt(m2 + (1 - m2) * p.cos_i * p.cos_i), root_o = std::sqrt(m2 + (1 - m2) * p.cos_o * p.cos_o);
  const AlbedoParts albedo = lobe_albedo(p.cos_o, mean);
  const double single = albedo.a + albedo.b;
  return {ggx_d(p, alpha.x, alpha.y) * 0.5 / (root_i * p.cos_o + root_o * p.cos_i), (1 - single) / single, albedo};
}

}  // namespace gonio::tabulated::targets::materialx
