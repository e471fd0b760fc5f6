// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/lobe_quadrature.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace gonio::tabulated {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int azimuths = 48;
constexpr int doublings = 10;  // of 1.5 mrad, to 90°
/// Gauss-Legendre nodes on [0, 1].
constexpr std::array<double, 4> node{0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
constexpr std::array<double, 4> weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};

}  // namespace

std::vector<LobeNode> lobe_quadrature(const Direction& wi) {
  std::vector<LobeNode> out;
  // wi·h vanishes at the largest theta_h; the half vectors beyond belong to directions below the surface.
  for (int panel = 0; panel <= doublings; ++panel) {
    const double low = panel == 0 ? 0 : pi / 2 * std::exp2(panel - 1 - doublings), high = pi / 2 * std::exp2(panel - doublings);
    for (std::size_t k = 0; k < node.size(); ++k) {
      const double theta = low + node[k] * (high - low), dtheta = weight[k] * (high - low);
      for (int a = 0; a < azimuths; ++a) {
        const double phi = 2 * pi * (a + 0.5) / azimuths;
        const double hx = std::sin(theta) * std::cos(phi), hy = std::sin(theta) * std::sin(phi), hz = std::cos(theta);
        const double cos_d = wi.x() * hx + wi.y() * hy + wi.z() * hz;
        if (!(cos_d > 0)) continue;
        const Direction wo = Direction::trusted(2 * cos_d * hx - wi.x(), 2 * cos_d * hy - wi.y(), 2 * cos_d * hz - wi.z());
        if (!(wo.z() > 0)) continue;
        out.push_back({wo, 4 * cos_d * std::sin(theta) * dtheta * 2 * pi / azimuths * wo.z()});
      }
    }
  }
  return out;
}

}  // namespace gonio::tabulated
