// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/samples_to_write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "brdf/error.hpp"
#include "tabulated/direction_grid.hpp"
#include "tabulated/node_values.hpp"

namespace gonio::tabulated {
namespace {

void count_samples(const Dataset& samples, ExportNotes& notes) {
  notes.n_nodes += samples.size();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    bool unknown = true, negative = false;
    for (const std::vector<double>& f : samples.f) {
      unknown = unknown && std::isnan(f[k]);
      negative = negative || f[k] < 0;
    }
    notes.n_unknown += unknown ? 1 : 0;
    notes.n_negative += negative ? 1 : 0;
  }
}

bool any_known(const std::vector<std::vector<double>>& u) {
  return std::any_of(u.begin(), u.end(), [](const std::vector<double>& column) {
    return std::any_of(column.begin(), column.end(), [](double value) { return !std::isnan(value); });
  });
}

}  // namespace

std::shared_ptr<const Dataset> samples_to_write(const Opened& source, const WriteOptions& options, ExportNotes& notes) {
  if (source.dataset) {
    count_samples(*source.dataset, notes);
    notes.facts.emplace_back("grid", fmt::format("the {} samples of the source, unchanged", source.dataset->size()));
    return source.dataset;
  }
  if (!source.brdf)
    throw Error(ErrorKind::input, {"the source", fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  const DirectionGrid grid = direction_grid(options.size, source.brdf->symmetry());
  const std::vector<GonioAngles> pairs = grid.pairs();
  std::vector<Direction> wi, wo;
  for (const GonioAngles& pair : pairs) wi.push_back(pair.wi()), wo.push_back(pair.wo());
  const NodeValues nodes = node_values(source, wi, wo, options.threads, notes);

  auto out = std::make_shared<Dataset>();
  const std::size_t channels = nodes.channel_count;
  out->channels = source.brdf->channels();
  out->symmetry = source.brdf->symmetry();
  out->simulated = source.simulated;
  out->f.resize(channels);
  if (!nodes.u.empty()) out->u.resize(channels);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto f = nodes.f.begin() + static_cast<std::ptrdiff_t>(k * channels);
    if (std::all_of(f, f + static_cast<std::ptrdiff_t>(channels), [](double value) { return std::isnan(value); })) continue;
    out->angles.push_back(pairs[k]);
    for (std::size_t c = 0; c < channels; ++c) {
      out->f[c].push_back(nodes.f[k * channels + c]);
      if (!nodes.u.empty()) out->u[c].push_back(nodes.u[k * channels + c]);
    }
    if (!nodes.coverage.empty()) out->extra["coverage"].push_back(static_cast<double>(nodes.coverage[k]));
  }
  if (!any_known(out->u)) out->u.clear();
  if (out->size() == 0) throw Error(ErrorKind::input, {"the source", "nothing known at any direction of the grid", "values to write"});
  if (!out->u.empty()) notes.lost.emplace_back("uncertainties are total ones: what samples share is no longer told apart");
  if (notes.n_unknown > 0) notes.lost.emplace_back("pairs of directions at which nothing is known are left out");

  const std::string words = fmt::format("{} theta_i x {} phi_i x {} theta_o x {} azimuths", grid.theta_i_deg.size(), grid.phi_i_deg.size(),
                                        grid.theta_o_deg.size(), grid.phi_deg.size());
  notes.facts.emplace_back("grid", words);
  out->provenance = {{"sampled", words}, {"sampled_from", source.format}};
  return out;
}

std::shared_ptr<const Dataset> with_both_sides(std::shared_ptr<const Dataset> samples) {
  if (!samples->symmetry.isotropic || !samples->symmetry.bilateral) return samples;
  // In the plane of incidence, to the rounding of a difference of azimuths, and at the normal there is no other side.
  constexpr double in_plane = 1e-12;
  const auto side = [&](std::size_t k) {
    const GonioAngles& at = samples->angles[k];
    return at.theta_i.sin() * at.theta_o.sin() * (at.phi_o - at.phi_i).sin();
  };
  std::vector<std::size_t> off_plane;
  for (std::size_t k = 0; k < samples->size(); ++k)
    if (std::fabs(side(k)) > in_plane) off_plane.push_back(k);
  if (off_plane.empty() || std::any_of(off_plane.begin(), off_plane.end(), [&](std::size_t k) { return side(k) * side(off_plane[0]) < 0; }))
    return samples;

  auto out = std::make_shared<Dataset>(*samples);
  const auto repeat = [&](std::vector<double>& column) {
    if (!column.empty())
      for (const std::size_t k : off_plane) column.push_back(column[k]);
  };
  for (const std::size_t k : off_plane) {
    out->angles.push_back(samples->angles[k]);
    out->angles.back().phi_o = samples->angles[k].phi_i + samples->angles[k].phi_i - samples->angles[k].phi_o;
  }
  for (auto* columns : {&out->f, &out->u})
    for (std::vector<double>& column : *columns) repeat(column);
  for (auto& [name, column] : out->extra) repeat(column);
  for (CorrelatedComponent& component : out->correlated) repeat(component.sensitivity);
  return out;
}

}  // namespace gonio::tabulated
