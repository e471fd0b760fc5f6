// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/numeric_albedo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gonio {
namespace {

constexpr double innermost = 1e-7;  // rad: nothing that a gonio-reflectometer sees is narrower
constexpr double growth = 1.5;      // of the panels
constexpr std::size_t azimuths = 128;
/// Gauss-Legendre nodes and weights with four points on [-1, 1].
constexpr std::array<double, 4> nodes{-0.86113631159405258, -0.33998104358485626, 0.33998104358485626, 0.86113631159405258};
constexpr std::array<double, 4> weights{0.34785484513745386, 0.65214515486254614, 0.65214515486254614, 0.34785484513745386};

}  // namespace

void numeric_albedo(const ModelInfo& model, Angle theta_i, Angle phi_i, const double* nonlinear, double* out) {
  const std::size_t count = model.linear_count;
  std::fill(out, out + count, 0.0);
  const Direction wi = Direction::spherical(theta_i, phi_i);
  // An orthonormal frame about the mirror direction r: e1 in the plane of incidence, e2 across it.
  const std::array<double, 3> r{-wi.x(), -wi.y(), wi.z()};
  const std::array<double, 3> e2{-phi_i.sin(), phi_i.cos(), 0};
  const std::array<double, 3> e1{e2[1] * r[2] - e2[2] * r[1], e2[2] * r[0] - e2[0] * r[2], e2[0] * r[1] - e2[1] * r[0]};
  std::vector<LobeGeometry> geometry;
  std::vector<double> weight;
  for (std::size_t j = 0; j < azimuths; ++j) {
    const double chi = 2 * std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(azimuths);
    // The height above the surface along this half circle is A sin(psi) + B cos(psi), B >= 0: positive up to the horizon, then not again.
    const double rise = std::cos(chi) * e1[2];
    const double horizon = rise > 0 ? std::numbers::pi - std::atan2(r[2], rise) : std::atan2(r[2], -rise);
    for (double from = 0, to = innermost; from < horizon; from = to, to *= growth) {
      const double end = std::min(to, horizon);
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        const double psi = 0.5 * (from + end) + 0.5 * (end - from) * nodes[n];
        const double a = std::sin(psi) * std::cos(chi), b = std::sin(psi) * std::sin(chi), c = std::cos(psi);
        const double z = a * e1[2] + b * e2[2] + c * r[2];
        if (!(z > 0)) continue;
        geometry.push_back(lobe_geometry(wi, Direction::trusted(a * e1[0] + b * e2[0] + c * r[0], a * e1[1] + b * e2[1] + c * r[1], z)));
        weight.push_back(0.5 * (end - from) * weights[n] * std::sin(psi) * 2 * std::numbers::pi / static_cast<double>(azimuths) * z);
      }
    }
  }
  std::vector<double> columns(count * geometry.size());
  model.basis(geometry, nonlinear, columns.data(), geometry.size());
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t row = 0; row < geometry.size(); ++row) out[k] += weight[row] * columns[k * geometry.size() + row];
}

}  // namespace gonio
