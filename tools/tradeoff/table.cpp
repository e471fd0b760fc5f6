// SPDX-License-Identifier: BSD-3-Clause
// Topic table: look-up tables of a BRDF, nanoseconds and bytes against error.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>
#include <utility>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/lookup_table.hpp"
#include "tools/tradeoff/compared_pairs.hpp"

namespace gonio::tools::tradeoff {
namespace {

using tabulated::Interpolation;
using tabulated::LookupLayout;
using tabulated::LookupTable;
using tabulated::NodeRule;
using tabulated::Parameterisation;
using tabulated::Storage;

struct Truth {
  const char* name;
  AnalyticBrdf brdf;
};

std::vector<Truth> truths() {
  const auto model = [](const char* name, std::vector<double> values) {
    return AnalyticBrdf(name, single_channel("value"), {std::move(values)});
  };
  return {{"Blinn-Phong, s = 10", model("blinn-phong", {0.2, 0.3, 10})},
          {"GGX, α = 0.1", model("ggx-separable", {0.2, 0.06, 0.3, 0.1})},
          {"Blinn-Phong, s = 1000", model("blinn-phong", {0.2, 0.3, 1000})}};
}

struct Layout {
  const char* name;
  LookupLayout layout;
};

/// The same number of nodes in every parameterisation.
std::vector<Layout> layouts(std::size_t n) {
  const auto half = [&](bool square_root) {
    return LookupLayout{Parameterisation::half_difference, {n, n, 2 * n}, NodeRule::ends, square_root};
  };
  return {{"half/difference, √θh", half(true)},
          {"half/difference, even θh", half(false)},
          {"θi, θo, φ", {Parameterisation::spherical, {n, n, 2 * n}, NodeRule::ends, false}}};
}

/// Directions as columns of floats.
struct Columns {
  explicit Columns(const std::vector<Direction>& directions) {
    for (const Direction& d : directions) x.push_back(float(d.x())), y.push_back(float(d.y())), z.push_back(float(d.z()));
  }
  tabulated::DirectionColumns view() const { return {{x, y, z}}; }
  std::vector<float> x, y, z;
};

/// No look-up can be faster than to add up what it is given.
double time_of_inputs(const Columns& wi, const Columns& wo, double least_run_s) {
  return time_of(
             [&] {
               float sum = 0;
               for (const Columns* columns : {&wi, &wo})
                 for (const auto* column : {&columns->x, &columns->y, &columns->z})
                   for (const float value : *column) sum += value;
               return static_cast<double>(sum);
             },
             wi.x.size(), least_run_s)
      .median_s;
}

std::string smallest_tables(const std::vector<Point>& points, const std::vector<double>& targets, std::size_t panels) {
  std::string out;
  for (const double target : targets) {
    std::map<std::pair<std::string, std::string>, std::pair<std::size_t, double>> settings;  // panels within the target, bytes
    for (const Point& point : points)
      if (point.error && *point.error <= target) {
        auto& [count, bytes] = settings[{point.method, point.setting}];
        ++count, bytes = *point.bytes;
      }
    const std::pair<std::string, std::string>* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [setting, found] : settings)
      if (found.first == panels && found.second < least) best = &setting, least = found.second;
    if (best)
      out += fmt::format("{}{:g} {} ({}, {:.3g} MB)", out.empty() ? "The smallest table: for " : "; for ", target, best->first,
                         best->second, least / 1e6);
  }
  return out.empty() ? out : out + ".";
}

}  // namespace

Measured measure_table(const Effort& effort) {
  Measured out;
  out.title = "Look-up tables of a BRDF: error against time (mean over pairs up to 80°, half of them near the mirror direction)";
  out.time_of = "time per look-up";
  out.error_of = "mean relative error";
  out.time_unit_s = 1e-9, out.time_unit = "ns";
  out.targets = {0.1, 0.03, 0.01, 3e-3};
  const std::vector<std::size_t> sizes = effort.quick ? std::vector<std::size_t>{23, 45} : std::vector<std::size_t>{12, 23, 45, 90, 180};
  const double least_run_s = effort.quick ? 1e-3 : 5e-3;
  const DirectionPairs pairs = compared_pairs(effort.quick ? 8192 : 65536);
  const Columns wi(pairs.wi), wo(pairs.wo);
  const double inputs = time_of_inputs(wi, wo, least_run_s);
  const std::vector<Truth> all = truths();
  double done = 0;
  for (const Truth& truth : all) {
    std::vector<double> wanted(pairs.wi.size());
    truth.brdf.eval(pairs.wi, pairs.wo, wanted);
    std::vector<float> value(pairs.wi.size());
    for (const std::size_t n : sizes)
      for (const auto& [name, layout] : layouts(n)) {
        effort.progress(done / static_cast<double>(all.size() * sizes.size() * 3), fmt::format("{}, {}", truth.name, n));
        ++done;
        for (const Storage storage : {Storage::f32, Storage::f16}) {
          const LookupTable table(truth.brdf, layout, storage, 2);
          for (const Interpolation interpolation : {Interpolation::nearest, Interpolation::linear}) {
            Point point;
            point.panel = truth.name;
            point.method = fmt::format("{}, {}", name, interpolation == Interpolation::nearest ? "nearest" : "linear");
            point.setting = fmt::format("{}×{}×{} {}", n, n, 2 * n, storage == Storage::f32 ? "float" : "half");
            point.bytes = static_cast<double>(table.grid().bytes());
            point.time = time_of(
                [&] {
                  table.eval(wi.view(), wo.view(), interpolation, value);
                  return static_cast<double>(value.front());
                },
                value.size(), least_run_s);
            const MeanError error = mean_relative_error(wanted, value);
            point.error = error.mean;
            point.worst_at = fmt::format("mean of the pairs, {:.2g} % of them unknown", 100 * error.unknown);
            out.points.push_back(std::move(point));
          }
        }
      }
    Panel panel;
    panel.name = truth.name;
    panel.error_floors = {{static_cast<double>(std::numeric_limits<float>::epsilon()) / 2, "rounding of a float, 6e-8"},
                          {2.4e-4, "mean rounding of a half, 2.4e-4"}};
    panel.limit = {inputs, fmt::format("reading the directions, {:.1f} ns", inputs * 1e9)};
    out.panels.push_back(std::move(panel));
  }
  if (std::string smallest = smallest_tables(out.points, out.targets, out.panels.size()); !smallest.empty())
    out.remarks.push_back(smallest);
  return out;
}

}  // namespace gonio::tools::tradeoff
