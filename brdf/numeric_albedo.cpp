// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/numeric_albedo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double innermost = 1e-7;  // rad: nothing that a gonio-reflectometer sees is narrower
constexpr double growth = 2;        // of the panels along theta_h
constexpr double widest_theta = 0.2;
/// Widest panel along phi_h. An anisotropic lobe turns its width within a part of the circle.
constexpr double widest_isotropic = 0.8, widest_anisotropic = 0.2;
constexpr double least_cosine = 1e-3;  // of the incidence, where the panels along phi_h stop to narrow
/// Gauss-Legendre nodes and weights with four points on [-1, 1].
constexpr std::array<double, 4> nodes{-0.86113631159405258, -0.33998104358485626, 0.33998104358485626, 0.86113631159405258};
constexpr std::array<double, 4> weights{0.34785484513745386, 0.65214515486254614, 0.65214515486254614, 0.34785484513745386};

struct Node {
  double at, weight;
};

/// Panels over [0, end] that start with `first` and double, none wider than `widest`.
std::vector<Node> doubling_panels(double end, double first, double widest) {
  std::vector<Node> out;
  for (double from = 0, width = first; from < end;) {
    const double to = end - from < 1.25 * width ? end : from + width;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      out.push_back({0.5 * (from + to) + 0.5 * (to - from) * nodes[n], 0.5 * (to - from) * weights[n]});
    from = to;
    width = std::min(widest, from * (growth - 1));
  }
  return out;
}

/// Azimuths of the half vector against the plane of incidence: half the circle stands for all of it if the model is isotropic.
std::vector<Node> azimuths(double cos_i, bool isotropic) {
  const double widest = isotropic ? widest_isotropic : widest_anisotropic;
  std::vector<Node> out;
  for (const Node& node : doubling_panels(pi / 2, std::min(widest, std::max(cos_i, least_cosine)), widest))
    for (const double side : {-1.0, 1.0}) {
      out.push_back({pi / 2 + side * node.at, isotropic ? 2 * node.weight : node.weight});
      if (!isotropic) out.push_back({-pi / 2 + side * node.at, node.weight});
    }
  return out;
}

}  // namespace

void numeric_albedo(const ModelInfo& model, Angle theta_i, Angle phi_i, const double* nonlinear, double* out) {
  const std::size_t count = model.linear_count;
  std::fill(out, out + count, 0.0);
  const Direction wi = Direction::spherical(theta_i, phi_i);
  const double si = theta_i.sin(), ci = theta_i.cos();
  std::vector<LobeGeometry> geometry;
  std::vector<double> weight;
  for (const Node& phi : azimuths(ci, model.properties.isotropic && model.properties.bilateral)) {
    const double along = si * std::cos(phi.at), cos_phi = std::cos(phi.at + phi_i.radians()), sin_phi = std::sin(phi.at + phi_i.radians());
    // cos theta_o = along sin 2theta_h + ci cos 2theta_h is positive up to one theta_h.
    const double horizon = 0.5 * (std::atan2(along, ci) + pi / 2);
    for (const Node& theta : doubling_panels(horizon, std::min(innermost, horizon), widest_theta)) {
      const double s = std::sin(theta.at), c = std::cos(theta.at);
      const double cos_d = along * s + ci * c, z = 2 * cos_d * c - ci;
      if (!(z > 0)) continue;
      geometry.push_back(lobe_geometry(wi, Direction::trusted(2 * cos_d * s * cos_phi - wi.x(), 2 * cos_d * s * sin_phi - wi.y(), z)));
      weight.push_back(phi.weight * theta.weight * s * 4 * cos_d * z);
    }
  }
  std::vector<double> columns(count * geometry.size());
  model.basis(geometry, nonlinear, columns.data(), geometry.size());
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t row = 0; row < geometry.size(); ++row) out[k] += weight[row] * columns[k * geometry.size() + row];
}

}  // namespace gonio
