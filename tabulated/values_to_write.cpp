// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/values_to_write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "brdf/error.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/lattice_table.hpp"
#include "tabulated/node_values.hpp"
#include "tabulated/opened_samples.hpp"

namespace gonio::tabulated {
namespace {

/// Angles that came through radians differ in their last digits.
constexpr double same_angle_deg = 1e-9;

/// theta_i, theta_o from the normal of its side, phi_o - phi_i in [0, 360), in degrees; azimuth 0 at the normal.
using Node = std::array<double, 3>;

Node node_of(const GonioAngles& pose, Side side) {
  const auto rounded = [](double degrees) { return std::round(degrees / same_angle_deg) * same_angle_deg; };
  const auto nearest = [&](double degrees) {
    // A whole number of hundredths, as people write angles, comes out as the same double as theirs.
    constexpr double hundredths = 100;
    const double short_one = std::round(degrees * hundredths) / hundredths;
    return std::fabs(short_one - degrees) < same_angle_deg ? short_one : rounded(degrees);
  };
  const double out = nearest(side == Side::transmission ? 180 - pose.theta_o.degrees() : pose.theta_o.degrees());
  double turn = nearest(std::fmod(pose.phi_o.degrees() - pose.phi_i.degrees(), 360.0));
  if (turn < 0) turn += 360;
  return {nearest(pose.theta_i.degrees()), out, out == 0 || turn == 360 ? 0 : turn};
}

/// At theta_i = 0 azimuths without a sample, which there is at least one of, take the first known value: f does not depend on them.
void fill_normal_incidence(const Lattice& lattice, std::vector<std::vector<double>>& values) {
  const std::size_t azimuths = lattice.nodes_deg[3].size();
  for (std::vector<double>& column : values)
    for (std::size_t o = 0; o < lattice.nodes_deg[2].size(); ++o) {
      const auto at = [&](std::size_t azimuth) -> double& { return column[lattice.index({0, 0, o, azimuth})]; };
      std::size_t known = 0;
      while (known < azimuths && std::isnan(at(known))) ++known;
      if (known == azimuths) continue;
      for (std::size_t k = 0; k < azimuths; ++k)
        if (std::isnan(at(k))) at(k) = at(known);
    }
}

}  // namespace

Side side_of(const Opened& source) { return source.dataset ? source.dataset->side : source.side; }

ChannelMap one_channel_or_xyz(const Channels& channels) {
  if (channels.size() > 1) return map_to_xyz(channels);
  return {.to = channels, .weights = {1}, .changed = {}};
}

ChannelMap one_channel(const Channels& channels) {
  if (channels.size() == 1) return one_channel_or_xyz(channels);
  ChannelMap out;
  if (channels.size() == 3 && channels[1].name == "Y") {
    out.to = {channels[1]};
    out.weights = {0, 1, 0};
  } else {
    out = map_to_luminance(channels);
  }
  out.changed = "the format has one channel: of the colours only the luminance Y is written";
  return out;
}

std::vector<std::vector<double>> values_to_write(const Opened& source, std::span<const GonioAngles> poses, const ChannelMap& map,
                                                 int threads, ExportNotes& notes) {
  std::vector<Direction> wi, wo;
  for (const GonioAngles& pose : poses) wi.push_back(pose.wi()), wo.push_back(pose.wo());
  const NodeValues nodes = node_values(source, wi, wo, threads, notes);
  if (!map.changed.empty()) notes.lost.push_back(map.changed);
  std::vector<double> mapped(map.to.size());
  std::vector<std::vector<double>> out(map.to.size(), std::vector<double>(poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) {
    map.apply(nodes.f.data() + k * nodes.channel_count, mapped.data());
    for (std::size_t c = 0; c < mapped.size(); ++c) out[c][k] = in_float_digits(mapped[c]);
  }
  return out;
}

Opened opened_grid(std::string format, std::shared_ptr<const Dataset> samples) {
  const std::optional<DirectionGrid> grid = grid_of_samples(*samples);
  Opened out = opened_samples(std::move(format), samples);
  if (!grid) return out;
  Lattice lattice{.nodes_deg = {grid->theta_i_deg, {0}, grid->theta_o_deg, grid->phi_deg}, .offset_deg = {}};
  lattice.bilateral = samples->symmetry.bilateral && grid->phi_deg.back() <= 180;
  lattice.side = samples->side;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<double>> values(samples->channels.size(), std::vector<double>(lattice.size(), unknown));
  const auto place = [](const std::vector<double>& nodes, double angle) {
    // Angles that came through radians lie beside their node.
    const auto above = std::lower_bound(nodes.begin(), nodes.end(), angle - same_angle_deg);
    return static_cast<std::size_t>(std::min(above, nodes.end() - 1) - nodes.begin());
  };
  for (std::size_t k = 0; k < samples->size(); ++k) {
    const Node node = node_of(samples->angles[k], samples->side);
    std::array<std::size_t, 4> at{place(grid->theta_i_deg, node[0]), 0, place(grid->theta_o_deg, node[1]), place(grid->phi_deg, node[2])};
    const bool normal = node[1] == 0;  // one sample for all azimuths
    for (at[3] = normal ? 0 : at[3]; at[3] < grid->phi_deg.size(); ++at[3]) {
      for (std::size_t c = 0; c < values.size(); ++c) values[c][lattice.index(at)] = samples->f[c][k];
      if (!normal) break;
    }
  }
  if (grid->theta_i_deg.front() == 0) fill_normal_incidence(lattice, values);
  out.brdf = std::make_shared<const LatticeTable>(std::move(lattice), samples->channels, std::move(values));
  return out;
}

std::optional<DirectionGrid> grid_of_samples(const Dataset& samples) {
  if (!samples.symmetry.isotropic || samples.size() == 0) return std::nullopt;
  std::set<Node> nodes;
  std::set<double> theta_i, theta_o, phi;
  for (const GonioAngles& pose : samples.angles) {
    const Node node = node_of(pose, samples.side);
    if (!nodes.insert(node).second) return std::nullopt;
    theta_i.insert(node[0]), theta_o.insert(node[1]);
    if (node[1] != 0) phi.insert(node[2]);
  }
  if (phi.empty()) return std::nullopt;
  const bool with_normal = *theta_o.begin() == 0;
  const std::size_t per_incidence = (theta_o.size() - (with_normal ? 1 : 0)) * phi.size() + (with_normal ? 1 : 0);
  // Light along the normal has no azimuth: one sample of each theta_o is enough.
  std::set<double> from_normal;
  std::size_t n_from_normal = 0;
  for (const Node& node : nodes)
    if (node[0] == 0) from_normal.insert(node[1]), ++n_from_normal;
  if (!from_normal.empty() && from_normal != theta_o) return std::nullopt;
  if (nodes.size() - n_from_normal != (theta_i.size() - (from_normal.empty() ? 0 : 1)) * per_incidence) return std::nullopt;
  DirectionGrid out;
  out.theta_i_deg.assign(theta_i.begin(), theta_i.end());
  out.phi_i_deg = {0};
  out.theta_o_deg.assign(theta_o.begin(), theta_o.end());
  out.phi_deg.assign(phi.begin(), phi.end());
  return out;
}

}  // namespace gonio::tabulated
