// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/sample_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "brdf/error.hpp"
#include "tabulated/direction_groups.hpp"

namespace gonio::tabulated {
namespace {

constexpr const char* coverage_column = "coverage";  // as samples_to_write names it
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double same_direction_rad = same_direction_deg * std::numbers::pi / 180;

/// Rows or columns: the distinct directions in order, and for every sample the one it belongs to.
struct Margin {
  std::vector<TableDirection> directions;
  std::vector<std::size_t> of_sample;
};

/// The column that says how values came about; a column of that name with other values means something else.
const std::vector<double>* coverage_of(const Dataset& dataset) {
  const auto column = dataset.extra.find(coverage_column);
  if (column == dataset.extra.end()) return nullptr;
  const auto& values = column->second;
  const bool known = std::all_of(values.begin(), values.end(), [](double value) { return value == 0 || value == 1 || value == 2; });
  return known ? &values : nullptr;
}

Margin margin_of(const Dataset& dataset, Angle GonioAngles::*theta, Angle GonioAngles::*phi) {
  std::vector<Direction> directions;
  directions.reserve(dataset.size());
  for (const GonioAngles& angles : dataset.angles) directions.push_back(Direction::spherical(angles.*theta, angles.*phi));
  const DirectionGroups groups = group_directions(directions, same_direction_rad);

  Margin out;
  std::vector<TableDirection> unsorted;
  for (const std::size_t sample : groups.first)
    unsorted.push_back({(dataset.angles[sample].*theta).degrees(), (dataset.angles[sample].*phi).degrees()});
  std::vector<std::size_t> order(unsorted.size()), rank(unsorted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(unsorted[a].theta_deg, unsorted[a].phi_deg) < std::pair(unsorted[b].theta_deg, unsorted[b].phi_deg);
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    rank[order[k]] = k;
    out.directions.push_back(unsorted[order[k]]);
  }
  out.of_sample.reserve(dataset.size());
  for (const std::size_t group : groups.group) out.of_sample.push_back(rank[group]);
  return out;
}

Dataset without_samples(const Dataset& dataset) {
  Dataset out;
  out.channels = dataset.channels;
  out.symmetry = dataset.symmetry;
  out.side = dataset.side;
  out.apertures = dataset.apertures;
  for (const CorrelatedComponent& component : dataset.correlated) out.correlated.push_back({component.name, component.u, {}});
  out.masked = dataset.masked;
  out.provenance = dataset.provenance;
  out.simulated = dataset.simulated;
  return out;
}

/// The mean of the samples of one cell in one channel.
struct Mean {
  double f = unknown, u = unknown;
  std::uint32_t count = 0;
};

Mean mean_of(const std::vector<double>& f, const std::vector<double>* u, std::span<const std::size_t> samples) {
  bool weighted = u != nullptr;
  for (const std::size_t k : samples) weighted = weighted && (std::isnan(f[k]) || !std::isnan((*u)[k]));
  Mean out;
  double sum = 0, weights = 0, lone_u = unknown;
  for (const std::size_t k : samples) {
    if (std::isnan(f[k])) continue;
    const double weight = weighted ? 1 / ((*u)[k] * (*u)[k]) : 1.0;
    sum += weight * f[k];
    weights += weight;
    if (++out.count == 1) out.f = f[k];
    if (weighted) lone_u = (*u)[k];
  }
  if (out.count == 1) out.u = lone_u;  // as it came, not through its square
  if (out.count > 1) {
    out.f = sum / weights;
    if (weighted) out.u = 1 / std::sqrt(weights);
  }
  return out;
}

}  // namespace

bool SampleTable::is_empty(std::size_t cell) const noexcept {
  return std::all_of(count.begin(), count.end(), [&](const std::vector<std::uint32_t>& counts) { return counts[cell] == 0; });
}

SampleTable tabulate(const Dataset& dataset) {
  dataset.require_consistent();
  const Margin rows = margin_of(dataset, &GonioAngles::theta_i, &GonioAngles::phi_i);
  const Margin columns = margin_of(dataset, &GonioAngles::theta_o, &GonioAngles::phi_o);
  const std::size_t m = rows.directions.size(), n = columns.directions.size();
  if (std::max(m, n) > max_table_directions || m * n > max_table_cells)
    throw Error(ErrorKind::input,
                {"the samples", fmt::format("{} incident and {} outgoing directions, {} cells for {} samples", m, n, m * n, dataset.size()),
                 fmt::format("directions that form a table of at most {} cells; scattered samples stay in a csv", max_table_cells)});

  SampleTable out;
  out.description = without_samples(dataset);
  out.incident = rows.directions;
  out.outgoing = columns.directions;
  const std::vector<double>* coverage = coverage_of(dataset);
  for (const auto& [name, values] : dataset.extra)
    if (&values != coverage) out.dropped_columns.push_back(name);
  if (coverage) out.coverage.assign(m * n, unknown);
  const std::size_t channel_count = dataset.channels.size();
  out.f.assign(channel_count, std::vector<double>(m * n, unknown));
  out.u = out.f;
  out.count.assign(channel_count, std::vector<std::uint32_t>(m * n, 0));
  out.sensitivity.assign(dataset.correlated.size(), std::vector<double>(m * n, unknown));
  out.deviation_deg.fill(std::vector<double>(m * n, 0));

  // Samples in the order of their cells, so that those of one cell stand together.
  std::vector<std::size_t> order(dataset.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto cell_of = [&](std::size_t sample) { return rows.of_sample[sample] * n + columns.of_sample[sample]; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return cell_of(a) < cell_of(b); });
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    const std::size_t cell = cell_of(order[first]);
    while (last < order.size() && cell_of(order[last]) == cell) ++last;
    const auto samples = std::span<const std::size_t>(order).subspan(first, last - first);
    const auto size = static_cast<double>(samples.size());
    for (std::size_t c = 0; c < channel_count; ++c) {
      const Mean mean = mean_of(dataset.f[c], dataset.has_uncertainty() ? &dataset.u[c] : nullptr, samples);
      out.f[c][cell] = mean.f, out.u[c][cell] = mean.u, out.count[c][cell] = mean.count;
    }
    const TableDirection &wi = out.incident[cell / n], &wo = out.outgoing[cell % n];
    for (const std::size_t k : samples) {
      const GonioAngles& angles = dataset.angles[k];
      const double deviations[] = {angles.theta_i.degrees() - wi.theta_deg, std::remainder(angles.phi_i.degrees() - wi.phi_deg, 360.0),
                                   angles.theta_o.degrees() - wo.theta_deg, std::remainder(angles.phi_o.degrees() - wo.phi_deg, 360.0)};
      for (std::size_t a = 0; a < out.deviation_deg.size(); ++a) out.deviation_deg[a][cell] += deviations[a] / size;
    }
    if (coverage)
      for (const std::size_t k : samples) out.coverage[cell] = std::fmax(out.coverage[cell], (*coverage)[k]);
    for (std::size_t component = 0; component < dataset.correlated.size(); ++component) {
      const std::vector<double>& sensitivity = dataset.correlated[component].sensitivity;
      if (sensitivity.empty()) continue;
      out.sensitivity[component][cell] = 0;
      for (const std::size_t k : samples) out.sensitivity[component][cell] += sensitivity[k] / size;
    }
  }
  return out;
}

Dataset samples_of(const SampleTable& table) {
  Dataset out = table.description;
  const std::size_t n = table.outgoing.size(), channel_count = table.f.size();
  out.f.resize(channel_count), out.u.resize(channel_count);
  const auto has_sensitivity = [&](std::size_t component) {
    return std::any_of(table.sensitivity[component].begin(), table.sensitivity[component].end(),
                       [](double value) { return !std::isnan(value); });
  };
  std::vector<bool> with_sensitivity;
  for (std::size_t component = 0; component < out.correlated.size(); ++component) with_sensitivity.push_back(has_sensitivity(component));
  std::vector<double> counts;
  bool averaged = false, known_u = false;
  for (std::size_t cell = 0; cell < table.cell_count(); ++cell) {
    if (table.is_empty(cell)) continue;
    const TableDirection &wi = table.incident[cell / n], &wo = table.outgoing[cell % n];
    const auto& deviation = table.deviation_deg;
    out.angles.push_back({degrees(wi.theta_deg + deviation[0][cell]), degrees(wi.phi_deg + deviation[1][cell]),
                          degrees(wo.theta_deg + deviation[2][cell]), degrees(wo.phi_deg + deviation[3][cell])});
    std::uint32_t count = 0;
    for (std::size_t c = 0; c < channel_count; ++c) {
      out.f[c].push_back(table.f[c][cell]);
      out.u[c].push_back(table.u[c][cell]);
      count = std::max(count, table.count[c][cell]);
      known_u = known_u || !std::isnan(table.u[c][cell]);
    }
    counts.push_back(count);
    if (!table.coverage.empty()) out.extra[coverage_column].push_back(table.coverage[cell]);
    averaged = averaged || count > 1;
    for (std::size_t component = 0; component < out.correlated.size(); ++component)
      if (with_sensitivity[component]) out.correlated[component].sensitivity.push_back(table.sensitivity[component][cell]);
  }
  if (!known_u) out.u.clear();
  if (averaged) out.extra["n"] = std::move(counts);
  return out;
}

}  // namespace gonio::tabulated
