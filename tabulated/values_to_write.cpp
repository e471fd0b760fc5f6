// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/values_to_write.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

#include "brdf/error.hpp"
#include "tabulated/csv_text.hpp"
#include "tabulated/node_values.hpp"

namespace gonio::tabulated {

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

std::optional<DirectionGrid> grid_of_samples(const Dataset& samples) {
  if (!samples.symmetry.isotropic || samples.size() == 0) return std::nullopt;
  using Node = std::array<double, 3>;
  std::set<Node> nodes;
  std::set<double> theta_i, theta_o, phi;
  for (const GonioAngles& pose : samples.angles) {
    const double out = samples.side == Side::transmission ? 180 - pose.theta_o.degrees() : pose.theta_o.degrees();
    // Angles that came through radians differ in their last digits.
    constexpr double digits = 1e9;
    const auto rounded = [](double degrees) { return std::round(degrees * digits) / digits; };
    double turn = rounded(std::fmod(pose.phi_o.degrees() - pose.phi_i.degrees(), 360.0));
    if (turn < 0) turn += 360;
    if (out == 0) turn = 0;  // the normal has no azimuth
    const Node node{rounded(pose.theta_i.degrees()), rounded(out), turn};
    if (!nodes.insert(node).second) return std::nullopt;
    theta_i.insert(node[0]), theta_o.insert(node[1]);
    if (out != 0) phi.insert(turn);
  }
  if (phi.empty()) return std::nullopt;
  const bool with_normal = *theta_o.begin() == 0;
  const std::size_t per_incidence = (theta_o.size() - (with_normal ? 1 : 0)) * phi.size() + (with_normal ? 1 : 0);
  if (nodes.size() != theta_i.size() * per_incidence) return std::nullopt;
  DirectionGrid out;
  out.theta_i_deg.assign(theta_i.begin(), theta_i.end());
  out.phi_i_deg = {0};
  out.theta_o_deg.assign(theta_o.begin(), theta_o.end());
  out.phi_deg.assign(phi.begin(), phi.end());
  return out;
}

}  // namespace gonio::tabulated
