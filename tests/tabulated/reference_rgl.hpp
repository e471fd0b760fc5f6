// SPDX-License-Identifier: BSD-3-Clause
// An evaluator of RGL files written from the published parameterisation alone, one pair at a time, as a check of writer and reader.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "tabulated/rgl_table.hpp"

namespace gonio::test {

/// Dupuy and Jakob 2018, section 4 and supplement: f cos theta_o = S(s) D(m) / (4 sigma(wi)), where s is the point of the unit square to
/// which the cumulative distribution of the visible half vectors sends m, rows first. Everything is computed from the arrays anew for each
/// pair: no table of integrals, no code shared with the library.
class ReferenceRgl {
 public:
  explicit ReferenceRgl(tabulated::RglArrays arrays) : a_(std::move(arrays)) {}

  std::size_t channel_count() const { return a_.channels.size(); }

  /// f without the cosine.
  std::vector<double> eval(const Direction& wi, const Direction& wo) const {
    std::vector<double> f(a_.channels.size(), 0.0);
    if (wi.z() <= 0 || wo.z() <= 0) return f;
    const double x = wi.x() + wo.x(), y = wi.y() + wo.y(), z = wi.z() + wo.z(), length = std::sqrt(x * x + y * y + z * z);
    const double theta_m = elevation(x / length, y / length, z / length), phi_m = std::atan2(y, x);
    const double theta_i = elevation(wi.x(), wi.y(), wi.z()), phi_i = std::atan2(wi.y(), wi.x());
    const bool isotropic = a_.phi_i.size() <= 2;
    const double mx = theta_to_u(theta_m), my = phi_to_u(isotropic ? phi_m - phi_i : phi_m);
    const std::vector<Part> parts = slices(phi_i, theta_i);

    double sx = 0, sy = 0;
    invert(parts, mx, my, sx, sy);
    const double scale = grid(a_.ndf.data(), a_.angle_rows, a_.angle_columns, mx, my) /
                         (4 * grid(a_.sigma.data(), a_.angle_rows, a_.angle_columns, theta_to_u(theta_i), phi_to_u(phi_i)) * wo.z());
    const std::size_t plane = a_.value_rows * a_.value_columns;
    for (std::size_t c = 0; c < f.size(); ++c)
      for (const Part& part : parts)
        f[c] += scale * part.weight * grid(a_.values.data() + (part.slice * f.size() + c) * plane, a_.value_rows, a_.value_columns, sx, sy);
    return f;
  }

 private:
  struct Part {
    std::size_t slice;
    double weight;
  };

  static double elevation(double x, double y, double z) { return 2 * std::asin(0.5 * std::sqrt(x * x + y * y + (z - 1) * (z - 1))); }
  static double theta_to_u(double theta) { return std::sqrt(theta * 2 / std::numbers::pi); }
  static double phi_to_u(double phi) {
    const double u = (phi + std::numbers::pi) / (2 * std::numbers::pi);
    return u - std::floor(u);
  }

  static std::vector<Part> along(const std::vector<float>& nodes, double at) {
    if (nodes.size() == 1 || at <= double(nodes.front())) return {{0, 1}};
    if (at >= double(nodes.back())) return {{nodes.size() - 1, 1}};
    std::size_t k = 0;
    while (double(nodes[k + 1]) < at) ++k;
    const double part = (at - double(nodes[k])) / (double(nodes[k + 1]) - double(nodes[k]));
    return {{k, 1 - part}, {k + 1, part}};
  }
  std::vector<Part> slices(double phi_i, double theta_i) const {
    std::vector<Part> out;
    for (const Part& p : along(a_.phi_i, phi_i))
      for (const Part& t : along(a_.theta_i, theta_i)) out.push_back({p.slice * a_.theta_i.size() + t.slice, p.weight * t.weight});
    return out;
  }

  static double grid(const float* values, std::size_t rows, std::size_t columns, double x, double y) {
    const double ax = std::min(x, 1.0) * double(columns - 1), ay = std::min(y, 1.0) * double(rows - 1);
    const auto i = std::min(std::size_t(ax), columns - 2), j = std::min(std::size_t(ay), rows - 2);
    const double fx = ax - double(i), fy = ay - double(j);
    const float* v = values + j * columns + i;
    return (1 - fy) * ((1 - fx) * double(v[0]) + fx * double(v[1])) + fy * ((1 - fx) * double(v[columns]) + fx * double(v[columns + 1]));
  }

  /// The density at a node, mixed over the slices, each of them normalised to the sum of its trapezoids.
  std::vector<double> mixed_density(const std::vector<Part>& parts) const {
    const std::size_t rows = a_.vndf_rows, columns = a_.vndf_columns;
    std::vector<double> out(rows * columns);
    for (const Part& part : parts) {
      const float* values = a_.vndf.data() + part.slice * rows * columns;
      double sum = 0;
      for (std::size_t j = 0; j + 1 < rows; ++j)
        for (std::size_t i = 0; i + 1 < columns; ++i)
          sum += 0.25 * (double(values[j * columns + i]) + double(values[j * columns + i + 1]) + double(values[(j + 1) * columns + i]) +
                         double(values[(j + 1) * columns + i + 1]));
      for (std::size_t k = 0; k < out.size(); ++k) out[k] += part.weight * double(values[k]) / sum;
    }
    return out;
  }

  void invert(const std::vector<Part>& parts, double x, double y, double& sx, double& sy) const {
    const std::size_t rows = a_.vndf_rows, columns = a_.vndf_columns;
    const std::vector<double> density = mixed_density(parts);
    const auto row_integral = [&](std::size_t j) {
      double sum = 0;
      for (std::size_t i = 0; i + 1 < columns; ++i) sum += 0.5 * (density[j * columns + i] + density[j * columns + i + 1]);
      return sum;
    };
    const double ay = y * double(rows - 1);
    const auto j = std::min(std::size_t(ay), rows - 2);
    const double fy = ay - double(j);
    sy = 0;
    for (std::size_t k = 0; k < j; ++k) sy += 0.5 * (row_integral(k) + row_integral(k + 1));
    const double low = row_integral(j), high = row_integral(j + 1);
    sy += fy * low + 0.5 * fy * fy * (high - low);

    const auto in_row = [&](std::size_t i) { return (1 - fy) * density[j * columns + i] + fy * density[(j + 1) * columns + i]; };
    const double ax = x * double(columns - 1);
    const auto i = std::min(std::size_t(ax), columns - 2);
    const double fx = ax - double(i);
    double sum = 0;
    for (std::size_t k = 0; k < i; ++k) sum += 0.5 * (in_row(k) + in_row(k + 1));
    sum += fx * in_row(i) + 0.5 * fx * fx * (in_row(i + 1) - in_row(i));
    sx = sum / ((1 - fy) * low + fy * high);
  }

  tabulated::RglArrays a_;
};

}  // namespace gonio::test
