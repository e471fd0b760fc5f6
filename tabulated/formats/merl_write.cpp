// SPDX-License-Identifier: BSD-3-Clause
// Tabulating a BRDF on MERL's grid.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <system_error>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "tabulated/formats/merl.hpp"
#include "tabulated/in_parallel.hpp"
#include "tabulated/node_values.hpp"

namespace gonio::tabulated {
namespace {

constexpr double masked_value = -1;

/// One pair of directions that a cell is made of, and its part of the cell.
struct CellPoint {
  DirectionPair pair;
  double weight;
};

/// The value at the node: one point.
void points_at_node(const MerlCell& cell, MerlNodes nodes, std::vector<CellPoint>& points) {
  points.assign(1, {directions(MerlGrid::node(cell, nodes)), 1.0});
}

/// The mean over the cell by two Gauss points an axis of (sqrt theta_h, theta_d, phi_d), exact for cubics. A pair of directions weighs
/// by d omega_i d omega_o = 4 cos theta_d d omega_h d omega_d (Rusinkiewicz 1998), so that the cells keep the reflected energy.
void points_over_cell(const MerlCell& cell, std::vector<CellPoint>& points) {
  constexpr double abscissas[] = {0.5 - 0.5 / std::numbers::sqrt3, 0.5 + 0.5 / std::numbers::sqrt3};
  points.clear();
  for (const double h : abscissas)
    for (const double d : abscissas)
      for (const double p : abscissas) {
        const double root = (static_cast<double>(cell.theta_h) + h) / MerlGrid::theta_h_count;
        const HalfDifference at{degrees(90 * root * root), degrees(0), degrees(static_cast<double>(cell.theta_d) + d),
                                degrees(static_cast<double>(cell.phi_d) + p)};
        // d theta_h = 2 root d root
        points.push_back({directions(at), root * at.theta_h.sin() * at.theta_d.sin() * at.theta_d.cos()});
      }
}

/// What became of one theta_h row.
struct Row {
  ExportNotes notes;
  std::size_t unknown = 0, negative = 0;  ///< cells
};

/// Fills the rows of the three planes, one by one and independently.
class TableWriter {
 public:
  TableWriter(const Opened& source, const WriteOptions& options, std::string& bytes)
      : source_(source), options_(options), bytes_(bytes), channels_(source.brdf->channels().size()) {}

  Row write(std::size_t row) {
    Row result;
    std::vector<CellPoint> points;
    std::vector<Direction> wi, wo;
    std::vector<double> weights;
    std::vector<std::size_t> first(MerlGrid::row_count + 1, 0);  // of each cell's points above the horizon
    for (std::size_t k = 0; k < MerlGrid::row_count; ++k) {
      const MerlCell cell = MerlGrid::cell(row * MerlGrid::row_count + k);
      if (options_.merl_values == MerlValues::cell_mean)
        points_over_cell(cell, points);
      else
        points_at_node(cell, options_.merl_nodes, points);
      for (const CellPoint& point : points)
        if (above_horizon(point.pair)) wi.push_back(point.pair.wi), wo.push_back(point.pair.wo), weights.push_back(point.weight);
      first[k + 1] = wi.size();
    }
    const NodeValues values = node_values(source_, wi, wo, 1, result.notes);
    for (std::size_t k = 0; k < MerlGrid::row_count; ++k) {
      const std::size_t cell = row * MerlGrid::row_count + k;
      if (first[k] == first[k + 1]) {
        mask(cell);
        ++result.notes.n_below_horizon;
        continue;
      }
      const std::array<double, 3> mean = mean_of(values, weights, first[k], first[k + 1]);
      const bool unknown = std::any_of(mean.begin(), mean.end(), [](double value) { return std::isnan(value); });
      if (unknown || std::any_of(mean.begin(), mean.end(), [](double value) { return value < 0; })) {
        mask(cell);
        ++(unknown ? result.unknown : result.negative);
        continue;
      }
      for (std::size_t c = 0; c < 3; ++c) store(c, cell, mean[c] / MerlPlanes::file_scale[c]);
    }
    return result;
  }

 private:
  /// Of the points where all is known; NaN if there is none.
  std::array<double, 3> mean_of(const NodeValues& values, const std::vector<double>& weights, std::size_t first, std::size_t last) const {
    std::array<double, 3> sum{};
    double total = 0;
    for (std::size_t k = first; k < last; ++k) {
      const auto f = std::span(values.f).subspan(k * channels_, channels_);
      if (std::any_of(f.begin(), f.end(), [](double value) { return std::isnan(value); })) continue;
      total += weights[k];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weights[k] * f[channels_ == 1 ? 0 : c];
    }
    if (last - first == 1 && total > 0) return {sum[0], sum[1], sum[2]};  // the weight of a node is 1: bit for bit
    for (double& value : sum) value = total > 0 ? value / total : std::numeric_limits<double>::quiet_NaN();
    return sum;
  }

  void mask(std::size_t cell) {
    for (std::size_t c = 0; c < 3; ++c) store(c, cell, masked_value);
  }
  void store(std::size_t plane, std::size_t cell, double value) {
    std::memcpy(bytes_.data() + merl_header_size + (plane * MerlGrid::cell_count + cell) * sizeof value, &value, sizeof value);
  }

  const Opened& source_;
  const WriteOptions& options_;
  std::string& bytes_;
  std::size_t channels_;
};

Row fill(const Opened& source, const WriteOptions& options, std::string& bytes) {
  TableWriter writer(source, options, bytes);
  std::mutex mutex;
  Row total;
  in_parallel(MerlGrid::theta_h_count, options.threads, [&](std::size_t row) {
    const Row result = writer.write(row);
    const std::lock_guard lock(mutex);
    total.notes.n_nodes += result.notes.n_nodes;
    total.notes.n_below_horizon += result.notes.n_below_horizon;
    total.notes.n_unknown += result.notes.n_unknown;
    total.notes.n_negative += result.notes.n_negative;
    total.notes.n_extrapolated += result.notes.n_extrapolated;
    total.unknown += result.unknown;
    total.negative += result.negative;
  });
  return total;
}

Json sidecar(const Row& result, const Opened& source, MerlNodes nodes, MerlValues values) {
  const auto& scale = MerlPlanes::file_scale;
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return Json::object({{"context", context({}, std::nullopt, source.simulated)},
                       {"format", "merl"},
                       {"node_rule", name(nodes)},
                       {"values", values == MerlValues::node ? "node" : "cell_mean"},
                       {"unit", "1/sr"},
                       {"cosine_included", false},
                       {"stored", "f / scale"},
                       {"scale", Json::object({{"r", scale[0]}, {"g", scale[1]}, {"b", scale[2]}})},
                       {"primaries", Json()},
                       {"primaries_note", "linear colour; the format does not define its primaries"},
                       {"source", source.format},
                       {"n_masked", Json::object({{"below_horizon", count(result.notes.n_below_horizon)},
                                                  {"nan", count(result.unknown)},
                                                  {"negative", count(result.negative)}})},
                       {"n_extrapolated", count(result.notes.n_extrapolated)}});
}

/// What stood in a small file, or nothing if there was none.
std::optional<std::string> contents_if_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error) ? std::optional(read_file(path)) : std::nullopt;
}

/// The sidecar first: a table without one would be read with the default rule. If the table then fails, the old pair stays.
void write_both(const std::filesystem::path& path, const std::string& table, const std::string& sidecar) {
  const std::filesystem::path beside = merl_sidecar(path);
  const std::optional<std::string> old_sidecar = contents_if_there(beside);
  write_file_atomically(beside, sidecar);
  try {
    write_file_atomically(path, table);
  } catch (...) {
    std::error_code error;
    if (old_sidecar)
      write_file_atomically(beside, *old_sidecar);
    else
      std::filesystem::remove(beside, error);
    throw;
  }
}

}  // namespace

ExportNotes write_merl(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  if (source.side == Side::transmission)
    throw Error(ErrorKind::input, {path.string(), fmt::format("the transmission of a {}", source.format), "reflection"});
  const Channels& channels = source.brdf->channels();
  if (channels.size() != 1 && channels.size() != 3)
    throw Error(ErrorKind::input,
                {path.string(), fmt::format("{} channels to be written", channels.size()), "one channel, or three for r, g, b"});
  const Symmetry symmetry = source.brdf->symmetry();
  const bool means = options.merl_values == MerlValues::cell_mean;
  const MerlNodes nodes = means ? MerlNodes::centre : options.merl_nodes;

  std::string bytes(merl_file_size, '\0');
  const std::int32_t dimensions[3] = {MerlGrid::theta_h_count, MerlGrid::theta_d_count, MerlGrid::phi_d_count};
  std::memcpy(bytes.data(), dimensions, sizeof dimensions);
  Row result = fill(source, options, bytes);
  if (result.notes.n_below_horizon + result.unknown + result.negative == MerlGrid::cell_count)
    throw Error(ErrorKind::input, {path.string(), "a BRDF that is known at no node of MERL's grid", "at least one value"});
  write_both(path, bytes, sidecar(result, source, nodes, options.merl_values).dump() + "\n");

  ExportNotes notes = std::move(result.notes);
  notes.files = {path, merl_sidecar(path)};
  notes.facts = {{"grid", "90 x 90 x 180 cells (theta_h, theta_d, phi_d)"},
                 {"nodes", name(nodes)},
                 {"values", means ? "means over the cells, for readers that take the nearest one" : "at the nodes"},
                 {"cells marked -1",
                  fmt::format("{} below the horizon, {} unknown, {} negative", notes.n_below_horizon, result.unknown, result.negative)}};
  if (result.unknown + result.negative > 0) notes.lost.emplace_back("cells with an unknown or negative value are marked -1: invalid");
  if (means && notes.n_unknown > 0) notes.lost.emplace_back("cells that are known in part are means over that part");
  if (channels.size() == 1) notes.lost.push_back(fmt::format("the one channel {} stands in all three planes", channels[0].name));
  if (!symmetry.isotropic) notes.lost.emplace_back("the format is isotropic: values are those at phi_h = 0");
  if (!symmetry.reciprocal) notes.lost.emplace_back("the format is reciprocal: of two swapped directions one pair is kept");
  if (source.uncertain) notes.lost.emplace_back("uncertainties");
  return notes;
}

}  // namespace gonio::tabulated
