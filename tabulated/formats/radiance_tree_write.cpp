// SPDX-License-Identifier: BSD-3-Clause
// A BRDF as tensor trees.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <numbers>
#include <utility>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/cell_mean.hpp"
#include "tabulated/describe.hpp"
#include "tabulated/formats/radiance_xml.hpp"
#include "tabulated/formats/radiance_xml_write.hpp"
#include "tabulated/formats/rgl_error.hpp"
#include "tabulated/formats/sphere_scene.hpp"
#include "tabulated/in_parallel.hpp"
#include "tabulated/radiance_colour.hpp"
#include "tabulated/tensor_tree_table.hpp"

namespace gonio::tabulated {
namespace {

/// Two rules that agree to a percent: the finer one is far closer, and cells are joined at that difference.
constexpr double settled = 1e-2;
/// Cells that differ from their mean by less are joined: a part of it, and 1e-5 1/sr, nothing beside the light of any lamp.
constexpr double joined_part = 0.01, joined_per_sr = 1e-5;
/// u' and v' that differ by less are one colour to the eye.
constexpr double joined_uv = 5e-4;

/// A cell with its mean, or its parts.
struct Cell {
  std::array<float, 3> f{};
  std::vector<Cell> parts;
};

/// One cell of the means of the parts where they hardly differ from them.
Cell joined(std::vector<Cell> parts) {
  Cell out;
  const auto count = static_cast<float>(parts.size());
  bool alike = std::all_of(parts.begin(), parts.end(), [](const Cell& part) { return part.parts.empty(); });
  for (std::size_t c = 0; c < 3 && alike; ++c) {
    for (const Cell& part : parts) out.f[c] += part.f[c] / count;
    for (const Cell& part : parts) alike = alike && std::fabs(part.f[c] - out.f[c]) <= joined_part * out.f[c] + joined_per_sr;
  }
  if (!alike) out.parts = std::move(parts);
  return out;
}

/// One number of every cell as a tree; parts that differ by at most `tolerance` are joined.
TensorTree tree_of(const Cell& cell, std::size_t dimensions, double tolerance,
                   const std::function<double(const std::array<float, 3>&)>& value) {
  if (cell.parts.empty()) return TensorTree(dimensions, static_cast<float>(value(cell.f)));
  std::vector<TensorTree> children;
  float low = 0, high = 0, sum = 0;
  for (const Cell& part : cell.parts) {
    children.push_back(tree_of(part, dimensions, tolerance, value));
    const float first = children.back().values()[0];
    low = children.size() == 1 ? first : std::min(low, first), high = std::max(high, first), sum += first;
  }
  if (std::all_of(children.begin(), children.end(), [](const TensorTree& child) { return child.is_constant(); }) && high - low <= tolerance)
    return TensorTree(dimensions, low == high ? low : sum / static_cast<float>(children.size()));
  return TensorTree::of_children(std::move(children));
}

class TreeWriter {
 public:
  TreeWriter(const Opened& source, const ChannelMap& map, std::size_t dimensions, std::size_t levels, bool front)
      : dimensions_(dimensions), levels_(levels), sign_(front ? -1 : 1), mean_(source, map, rules(dimensions), settled) {}

  /// The two upper levels are cut into pieces of work for the threads.
  Cell write(int threads, RadianceMeans& means, ExportNotes& notes) const {
    const std::size_t branches = std::size_t{1} << dimensions_;
    std::vector<Cell> cells(branches * branches);
    std::mutex mutex;
    in_parallel(cells.size(), threads, [&](std::size_t k) {
      RadianceMeans part;
      ExportNotes counts;
      cells[k] = cell(corner_of(corner_of({}, 0.5, k / branches), 0.25, k % branches), 2, part, counts);
      const std::lock_guard lock(mutex);
      means.add(part);
      add_counts(counts, notes);
    });
    std::vector<Cell> halves;
    for (std::size_t k = 0; k < branches; ++k) {
      const auto first = cells.begin() + static_cast<std::ptrdiff_t>(k * branches);
      halves.push_back(joined({std::make_move_iterator(first), std::make_move_iterator(first + static_cast<std::ptrdiff_t>(branches))}));
    }
    return joined(std::move(halves));
  }

 private:
  /// Points a dimension: in four dimensions there are many of them, and 3 or 4 already meet a lobe at 9 or 16 places an axis.
  static std::vector<std::size_t> rules(std::size_t dimensions) {
    return dimensions == 3 ? std::vector<std::size_t>{1, 2, 4, 8} : std::vector<std::size_t>{1, 2, 3, 4};
  }

  TensorTree::Position corner_of(TensorTree::Position corner, double edge, std::size_t child) const {
    for (std::size_t i = 0; i < dimensions_; ++i) corner[i] += (child >> i) & 1 ? edge : 0;
    return corner;
  }

  Cell cell(const TensorTree::Position& corner, std::size_t level, RadianceMeans& means, ExportNotes& notes) const {
    if (dimensions_ == 3 && corner[0] >= 0.5) return {};  // this half of the cube is no direction
    const double edge = std::ldexp(1.0, -static_cast<int>(level));
    if (level < levels_) {
      std::vector<Cell> parts;
      for (std::size_t k = 0; k < std::size_t{1} << dimensions_; ++k)
        parts.push_back(cell(corner_of(corner, edge / 2, k), level + 1, means, notes));
      return joined(std::move(parts));
    }
    const auto pair = [&](std::span<const double> at) {
      TensorTree::Position position{};
      for (std::size_t i = 0; i < dimensions_; ++i) position[i] = corner[i] + edge * at[i];
      return tree_directions(dimensions_, position, sign_);
    };
    const CellMean::Result result = mean_(dimensions_, pair, 1, notes);
    const std::array<double, 3> f = written_mean(result.f, result.known, result.unsettled, means);
    return {{static_cast<float>(f[0]), static_cast<float>(f[1]), static_cast<float>(f[2])}, {}};
  }

  std::size_t dimensions_, levels_;
  double sign_;
  CellMean mean_;
};

/// The largest part of light that comes back, over the finest cells of incidence.
double largest_hemispherical(const TensorTree& tree, std::size_t levels) {
  const std::size_t incident = tree.dimensions() - 2, bins = std::size_t{1} << levels;
  std::vector<double> sums(incident == 1 ? bins : bins * bins);
  tree.visit([&](const TensorTree::Position& corner, double edge, float value) {
    const auto first = [&](std::size_t i) { return static_cast<std::size_t>(corner[i] * static_cast<double>(bins)); };
    const auto count = static_cast<std::size_t>(edge * static_cast<double>(bins));
    const double part = std::numbers::pi * edge * edge * static_cast<double>(value);
    for (std::size_t x = first(0); x < first(0) + count; ++x)
      for (std::size_t y = first(1); incident == 2 && y < first(1) + count; ++y) sums[x * bins + y] += part;
    for (std::size_t x = first(0); incident == 1 && x < first(0) + count; ++x) sums[x] += part;
  });
  return *std::max_element(sums.begin(), sums.end());
}

struct Written {
  TreeChannels back, front;
  ExportNotes notes;
  RadianceMeans means;
};

TreeChannels channels_of(const Cell& cell, std::size_t dimensions, bool colour) {
  const auto rgb = [](const std::array<float, 3>& f) { return std::array<double, 3>{f[0], f[1], f[2]}; };
  if (!colour) return {tree_of(cell, dimensions, 0, [](const auto& f) { return static_cast<double>(f[0]); }), {}, {}};
  return {tree_of(cell, dimensions, 0, [&](const auto& f) { return xyz_of_rgb(rgb(f))[1]; }),
          tree_of(cell, dimensions, joined_uv, [&](const auto& f) { return uv_of_xyz(xyz_of_rgb(rgb(f)))[0]; }),
          tree_of(cell, dimensions, joined_uv, [&](const auto& f) { return uv_of_xyz(xyz_of_rgb(rgb(f)))[1]; })};
}

Written trees(const Opened& source, const ChannelMap& map, std::size_t dimensions, std::size_t levels, int threads) {
  ExportNotes notes;
  RadianceMeans means;
  const bool colour = map.to.size() == 3;
  TreeChannels back = channels_of(TreeWriter(source, map, dimensions, levels, false).write(threads, means, notes), dimensions, colour);
  // Turned over, a surface that is the same in the mirror is the same.
  const bool same = source.brdf->symmetry().bilateral && source.brdf->symmetry().isotropic;
  TreeChannels front =
      same ? back : channels_of(TreeWriter(source, map, dimensions, levels, true).write(threads, means, notes), dimensions, colour);
  means.hemispherical[0] = largest_hemispherical(back.luminance, levels);
  return {std::move(back), std::move(front), std::move(notes), means};
}

/// The coarsest tree that keeps `options.error`, or the one of `options.size`, with what was tried in `curve`.
Written chosen(const Opened& source, const ChannelMap& map, std::size_t dimensions, const WriteOptions& options, std::size_t& levels,
               std::string& curve, bool& kept) {
  const std::size_t coarsest = dimensions == 3 ? 4 : 3, finest = dimensions == 3 ? 8 : 5;
  for (levels = coarsest;; ++levels) {
    Written out = trees(source, map, dimensions, levels, options.threads);
    const TensorTreeTable table(out.back, {});
    const double error = mean_relative_error(*source.brdf, map, table, options.threads);
    curve += fmt::format("{}{}: {:.3g} %", curve.empty() ? "" : "; ", std::size_t{1} << levels, 100 * error);
    kept = error <= *options.error;
    if (kept || levels == finest) return out;
  }
}

ExportNotes write(const Opened& source, const std::filesystem::path& path, const WriteOptions& options, std::size_t dimensions) {
  const ChannelMap map = radiance_channels(source);
  const Symmetry symmetry = source.brdf->symmetry();
  if (dimensions == 3 && !symmetry.isotropic)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a BRDF with the symmetry '{}'", words(symmetry)),
                                   "an isotropic one; radiance-tree4 holds any"});
  std::size_t levels = (dimensions == 3 ? 5 : 3) + (options.size == GridSize::paper ? 0 : options.size == GridSize::standard ? 1 : 2);
  std::string curve;
  bool kept = true;
  Written written = options.error ? chosen(source, map, dimensions, options, levels, curve, kept)
                                  : trees(source, map, dimensions, levels, options.threads);
  std::vector<RadianceBlock> blocks;
  for (const bool is_front : {false, true}) {
    const TreeChannels& side = is_front ? written.front : written.back;
    blocks.push_back({"Visible", is_front, side.luminance.text()});
    if (!side.u) continue;
    blocks.push_back({"CIE-u", is_front, side.u->text()});
    blocks.push_back({"CIE-v", is_front, side.v->text()});
  }
  write_file_atomically(path, radiance_document(fmt::format("TensorTree{}", dimensions), nullptr, path.stem().string(), blocks));
  ExportNotes notes = std::move(written.notes);
  notes.files = {path};
  if (options.scene)
    for (const auto& scene : write_sphere_scenes("radiance-xml", path)) notes.files.push_back(scene);
  notes.facts.emplace_back("grid", fmt::format("tensor tree of rank {}, {} divisions of an axis at most, {} cells", dimensions,
                                               std::size_t{1} << levels, written.back.luminance.leaf_count()));
  notes.facts.emplace_back("joined", fmt::format("cells within {} % of their mean", 100 * joined_part));
  if (!curve.empty()) notes.facts.emplace_back("errors by divisions", curve);
  if (!kept) notes.lost.emplace_back("the wanted error is not reached by the finest tree that is tried");
  note_means(written.means, map, notes);
  return notes;
}

}  // namespace

ExportNotes write_radiance_tree3(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(source, path, options, 3);
}
ExportNotes write_radiance_tree4(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(source, path, options, 4);
}

}  // namespace gonio::tabulated
