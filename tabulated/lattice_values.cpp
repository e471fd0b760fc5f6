// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/lattice_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "brdf/error.hpp"
#include "tabulated/node_values.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<std::vector<double>> lattice_values(const Opened& source, const Lattice& lattice, const ChannelMap& map, int threads,
                                                ExportNotes& notes) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {"the source", fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  if (source.side != lattice.side)
    throw Error(ErrorKind::input, {"the source", "scatter to the other side of the surface", "what the format holds"});
  const Symmetry symmetry = source.brdf->symmetry();
  if (!symmetry.isotropic && lattice.nodes_deg[1].size() == 1)
    throw Error(ErrorKind::input, {"the source", "a BRDF that depends on phi_i", "an isotropic one: the format has no phi_i"});
  const auto* own = dynamic_cast<const LatticeTable*>(source.brdf.get());
  if (own != nullptr && own->lattice() == lattice && own->channels() == map.to) {
    notes.n_nodes += lattice.size();
    notes.facts.emplace_back("values", "those of the source, which has this grid");
    return own->values();
  }

  std::vector<std::size_t> nodes;
  std::vector<Direction> wi, wo;
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    const GonioAngles at = lattice.angles(node);
    if (!lattice.has_directions(at)) continue;
    nodes.push_back(node);
    wi.push_back(at.wi());
    wo.push_back(at.wo());
  }
  notes.n_below_horizon += lattice.size() - nodes.size();
  NodeValues at_nodes = node_values(source, wi, wo, threads, notes);
  if (lattice.bilateral && !symmetry.bilateral) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const GonioAngles at = lattice.angles(nodes[k]);
      wo[k] = Direction::spherical(at.theta_o, at.phi_i + at.phi_i - at.phi_o);
    }
    ExportNotes other_side;
    const NodeValues mirrored = node_values(source, wi, wo, threads, other_side);
    for (std::size_t k = 0; k < at_nodes.f.size(); ++k)
      if (std::isnan(at_nodes.f[k]))
        at_nodes.f[k] = mirrored.f[k];
      else if (!std::isnan(mirrored.f[k]))
        at_nodes.f[k] = (at_nodes.f[k] + mirrored.f[k]) / 2;
    notes.lost.emplace_back("the two sides of the plane of incidence are averaged: the format has one");
  }
  if (!map.changed.empty()) notes.lost.push_back(map.changed);

  std::vector<std::vector<double>> out(map.to.size(), std::vector<double>(lattice.size(), unknown));
  std::vector<double> mapped(map.to.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    map.apply(&at_nodes.f[k * at_nodes.channel_count], mapped.data());
    for (std::size_t c = 0; c < mapped.size(); ++c) out[c][nodes[k]] = mapped[c];
  }
  return out;
}

std::size_t fill_unknown(const Lattice& lattice, std::vector<std::vector<double>>& values) {
  std::size_t filled = 0;
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    std::array<std::size_t, 4> at = lattice.position(node);
    const bool has_neighbour = at[2] > 0 || at[0] > 0;
    if (has_neighbour) --(at[2] > 0 ? at[2] : at[0]);
    const std::size_t neighbour = lattice.index(at);
    bool unfilled = false;
    for (std::vector<double>& column : values)
      if (std::isnan(column[node])) {
        column[node] = has_neighbour ? column[neighbour] : 0;
        unfilled = true;
      }
    filled += unfilled ? 1 : 0;
  }
  return filled;
}

}  // namespace gonio::tabulated
