// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/lattice_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "brdf/error.hpp"
#include "tabulated/beta_offset.hpp"
#include "tabulated/distorted_angles.hpp"
#include "tabulated/specular_angles.hpp"

namespace gonio::tabulated {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The mirror image at the surface: transmission is tabulated as if it were reflected.
Direction mirrored(const Direction& w) { return Direction::trusted(w.x(), w.y(), -w.z()); }

/// In [0, 360).
double turn(double phi_deg) {
  const double out = std::fmod(phi_deg, 360.0);
  const double positive = out < 0 ? out + 360 : out;
  return positive < 360 ? positive : 0;
}

/// Two neighbours on an axis and the weight of the second.
struct Bracket {
  std::array<std::size_t, 2> node{0, 0};
  double weight = 0;
};

Bracket bracket_between(const std::vector<double>& nodes, double value) {
  if (!(value > nodes.front())) return {};
  if (value >= nodes.back()) return {{nodes.size() - 1, nodes.size() - 1}, 0};
  const auto above = static_cast<std::size_t>(std::upper_bound(nodes.begin(), nodes.end(), value) - nodes.begin());
  return {{above - 1, above}, (value - nodes[above - 1]) / (nodes[above] - nodes[above - 1])};
}

/// The same on a circle: from the last node on to the first.
Bracket bracket_around(const std::vector<double>& nodes, double phi_deg) {
  const double value = nodes.front() + turn(phi_deg - nodes.front());
  if (value <= nodes.back()) return bracket_between(nodes, value);
  const double gap = nodes.front() + 360 - nodes.back();
  return {{nodes.size() - 1, 0}, (value - nodes.back()) / gap};
}

/// The offset of a zenith angle of incidence, linear between those of the nodes.
double offset_at(const Lattice& lattice, double theta_i_deg) {
  if (lattice.offset_deg.empty()) return 0;
  const Bracket at = bracket_between(lattice.nodes_deg[0], theta_i_deg);
  return (1 - at.weight) * lattice.offset_deg[at.node[0]] + at.weight * lattice.offset_deg[at.node[1]];
}

/// The pole of distorted coordinates: the specular direction moved by the offset, above the surface.
Direction distorted_pole(double theta_i_deg, double offset_deg, Angle phi_i) {
  constexpr double nearly_horizontal_deg = 90 - 1e-9;
  return Direction::spherical(degrees(std::min(theta_i_deg + offset_deg, nearly_horizontal_deg)), phi_i + degrees(180));
}

/// The four angles of a pair above the surface, in degrees.
std::array<double, 4> coordinates_of(const Lattice& lattice, const Direction& wi, const Direction& wo) {
  const bool isotropic = lattice.nodes_deg[1].size() == 1;
  switch (lattice.coordinates) {
    case LatticeCoordinates::spherical: {
      const double phi_i = wi.phi().degrees(), phi_o = wo.phi().degrees();
      return {wi.theta().degrees(), phi_i, wo.theta().degrees(), isotropic ? phi_o - phi_i : phi_o};
    }
    case LatticeCoordinates::specular: {
      const double theta_i = wi.theta().degrees();
      const Direction mean = Direction::spherical(degrees(theta_i + offset_at(lattice, theta_i)), wi.phi());
      const SpecularAngles angles = to_specular(mean, wo, Side::reflection);
      return {theta_i, wi.phi().degrees(), angles.radial_deg, angles.azimuth_deg};
    }
    case LatticeCoordinates::distorted: {
      const double theta_i = wi.theta().degrees(), phi_i = wi.phi().degrees();
      const DistortedAngles angles = to_distorted(distorted_pole(theta_i, offset_at(lattice, theta_i), wi.phi()), wo);
      return {theta_i, phi_i, angles.polar_deg, isotropic ? angles.azimuth_deg - phi_i : angles.azimuth_deg};
    }
    case LatticeCoordinates::beta: {
      const BetaOffset offset = to_beta_offset(wi, wo);
      return {wi.theta().degrees(), wi.phi().degrees(), offset.length, offset.azimuth_deg};
    }
    case LatticeCoordinates::half_difference: break;
  }
  const HalfDifference angles = half_difference(wi, wo);
  return {angles.theta_h.degrees(), angles.phi_h.degrees(), angles.theta_d.degrees(), angles.phi_d.degrees()};
}

/// The last angle where the lattice has it.
double folded(const Lattice& lattice, double phi_deg) {
  double out = turn(phi_deg);
  const double period = lattice.reciprocal ? 180 : 360;
  if (lattice.reciprocal && out >= period) out -= period;
  return lattice.bilateral && out > period / 2 ? period - out : out;
}

Bracket last_bracket(const Lattice& lattice, double phi_deg) {
  const std::vector<double>& nodes = lattice.nodes_deg[3];
  if (lattice.bilateral) return bracket_between(nodes, folded(lattice, phi_deg));
  if (!lattice.reciprocal) return bracket_around(nodes, phi_deg);
  // Half a turn is a whole one of doubled angles.
  const double value = folded(lattice, phi_deg);
  if (value >= nodes.front() && value <= nodes.back()) return bracket_between(nodes, value);
  const double gap = nodes.front() + 180 - nodes.back();
  const double beyond = value > nodes.back() ? value - nodes.back() : value + 180 - nodes.back();
  return {{nodes.size() - 1, 0}, gap > 0 ? beyond / gap : 0};
}

}  // namespace

std::size_t Lattice::size() const noexcept { return nodes_deg[0].size() * nodes_deg[1].size() * nodes_deg[2].size() * nodes_deg[3].size(); }

std::size_t Lattice::index(const std::array<std::size_t, 4>& at) const noexcept {
  return at[0] + nodes_deg[0].size() * (at[1] + nodes_deg[1].size() * (at[2] + nodes_deg[2].size() * at[3]));
}

std::array<std::size_t, 4> Lattice::position(std::size_t index) const noexcept {
  std::array<std::size_t, 4> out{};
  for (std::size_t axis = 0; axis < 4; ++axis) {
    out[axis] = index % nodes_deg[axis].size();
    index /= nodes_deg[axis].size();
  }
  return out;
}

GonioAngles Lattice::angles(std::size_t index) const {
  const std::array<std::size_t, 4> at = position(index);
  std::array<Angle, 4> angle;
  for (std::size_t axis = 0; axis < 4; ++axis) angle[axis] = degrees(nodes_deg[axis][at[axis]]);
  GonioAngles out;
  switch (coordinates) {
    case LatticeCoordinates::spherical:
      out = {angle[0], angle[1], angle[2], nodes_deg[1].size() == 1 ? angle[1] + angle[3] : angle[3]};
      break;
    case LatticeCoordinates::specular: {
      const Angle mean = offset_deg.empty() ? angle[0] : degrees(angle[0].degrees() + offset_deg[at[0]]);
      out = from_specular(mean, angle[1], {angle[2].degrees(), angle[3].degrees()}, Side::reflection);
      out.theta_i = angle[0];
      break;
    }
    case LatticeCoordinates::distorted: {
      const Direction pole = distorted_pole(angle[0].degrees(), offset_deg.empty() ? 0 : offset_deg[at[0]], angle[1]);
      const Angle azimuth = nodes_deg[1].size() == 1 ? angle[1] + angle[3] : angle[3];
      const Direction wo = from_distorted(pole, {angle[2].degrees(), azimuth.degrees()});
      out = {angle[0], angle[1], wo.theta(), wo.phi()};
      break;
    }
    case LatticeCoordinates::beta: {
      const Angle azimuth = angle[1] + degrees(180) + angle[3], none = degrees(180);
      out = from_beta_offset(angle[0], angle[1], nodes_deg[2][at[2]], azimuth, Side::reflection)
                .value_or(GonioAngles{angle[0], angle[1], none, angle[3]});
      break;
    }
    case LatticeCoordinates::half_difference: {
      const DirectionPair pair = directions({angle[0], angle[1], angle[2], angle[3]});
      out = gonio_angles(pair.wi, pair.wo);
      break;
    }
  }
  if (side == Side::transmission) out.theta_o = degrees(180) - out.theta_o;
  return out;
}

bool Lattice::has_directions(const GonioAngles& node) const noexcept {
  const double cos_o = side == Side::transmission ? -node.theta_o.cos() : node.theta_o.cos();
  // The horizon itself, to the rounding of directions: f is the limit of a ratio there.
  constexpr double rounding = 1e-9;
  return node.theta_i.cos() > rounding && cos_o > rounding;
}

Symmetry Lattice::symmetry() const noexcept {
  return {.isotropic = nodes_deg[1].size() == 1, .bilateral = bilateral, .reciprocal = reciprocal};
}

LatticeTable::LatticeTable(Lattice lattice, Channels channels, std::vector<std::vector<double>> values)
    : lattice_(std::move(lattice)), channels_(std::move(channels)), values_(std::move(values)), usable_(lattice_.size()) {
  if (values_.size() != channels_.size() ||
      std::any_of(values_.begin(), values_.end(), [&](const auto& column) { return column.size() != lattice_.size(); }))
    throw Error(ErrorKind::internal, {"a table", "another number of values than nodes", "one for every node and channel"});
  for (std::size_t node = 0; node < usable_.size(); ++node)
    usable_[node] = lattice_.has_directions(lattice_.angles(node)) &&
                    std::none_of(values_.begin(), values_.end(), [&](const auto& column) { return std::isnan(column[node]); });
}

void LatticeTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  const std::size_t channel_count = channels_.size();
  const bool transmission = lattice_.side == Side::transmission;
  for (std::size_t k = 0; k < wi.size(); ++k) {
    const std::span<double> out = f.subspan(k * channel_count, channel_count);
    std::fill(out.begin(), out.end(), 0.0);
    const Direction outgoing = transmission ? mirrored(wo[k]) : wo[k];
    if (!(wi[k].z() > 0) || !(outgoing.z() > 0)) continue;
    const std::array<double, 4> at = coordinates_of(lattice_, wi[k], outgoing);
    const std::array<Bracket, 4> brackets{bracket_between(lattice_.nodes_deg[0], at[0]), bracket_around(lattice_.nodes_deg[1], at[1]),
                                          bracket_between(lattice_.nodes_deg[2], at[2]), last_bracket(lattice_, at[3])};
    double weights = 0;
    for (unsigned corner = 0; corner < 16; ++corner) {
      double weight = 1;
      std::array<std::size_t, 4> node{};
      for (unsigned axis = 0; axis < 4; ++axis) {
        const unsigned second = (corner >> axis) & 1U;
        node[axis] = brackets[axis].node[second];
        weight *= second ? brackets[axis].weight : 1 - brackets[axis].weight;
      }
      const std::size_t index = lattice_.index(node);
      if (!(weight > 0) || !usable_[index]) continue;
      weights += weight;
      for (std::size_t c = 0; c < channel_count; ++c) out[c] += weight * values_[c][index];
    }
    for (double& value : out) value = weights > 0 ? value / weights : unknown;
  }
}

Dataset LatticeTable::samples() const {
  Dataset out;
  out.channels = channels_;
  out.symmetry = symmetry();
  out.side = lattice_.side;
  out.f.resize(channels_.size());
  for (std::size_t node = 0; node < usable_.size(); ++node) {
    const GonioAngles angles = lattice_.angles(node);
    if (!lattice_.has_directions(angles)) {
      ++out.masked.below_horizon;
      continue;
    }
    if (std::all_of(values_.begin(), values_.end(), [&](const auto& column) { return std::isnan(column[node]); })) {
      ++out.masked.nan;
      continue;
    }
    // The same direction as another node: azimuth 360° is 0, and at the pole every azimuth is the first.
    std::array<std::size_t, 4> first = lattice_.position(node);
    for (const std::size_t axis : {1u, 3u}) {
      const std::vector<double>& nodes = lattice_.nodes_deg[axis];
      if (first[axis] + 1 == nodes.size() && nodes.back() - nodes.front() == 360) first[axis] = 0;
    }
    if (lattice_.nodes_deg[2][first[2]] == 0) first[3] = 0;
    const std::size_t other = lattice_.index(first);
    if (other != node && std::all_of(values_.begin(), values_.end(), [&](const auto& column) { return column[node] == column[other]; }))
      continue;
    out.angles.push_back(angles);
    for (std::size_t c = 0; c < channels_.size(); ++c) out.f[c].push_back(values_[c][node]);
  }
  return out;
}

}  // namespace gonio::tabulated
