// SPDX-License-Identifier: BSD-3-Clause
// RGL files: bench_rgl prints how long the standard size takes to write, and what a look-up costs beside a direct scalar transcription of
// the published formulas on the same arrays, both on one thread.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/formats/rgl.hpp"
#include "tests/bench/thread_clock.hpp"
#include "tests/temporary_folder.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using bench::cpu_seconds;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Dupuy and Jakob 2018 as published: integrals of the density and everything else in the arrays' own order, one value after the other.
class DirectRgl {
 public:
  explicit DirectRgl(RglArrays arrays) : a_(std::move(arrays)), along_(a_.vndf.size()), across_(a_.vndf.size() / a_.vndf_columns) {
    const std::size_t rows = a_.vndf_rows, columns = a_.vndf_columns;
    for (std::size_t slice = 0; slice < across_.size() / rows; ++slice) {
      float* density = a_.vndf.data() + slice * rows * columns;
      double* along = along_.data() + slice * rows * columns;
      double* across = across_.data() + slice * rows;
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 1; i < columns; ++i)
          along[j * columns + i] =
              along[j * columns + i - 1] + 0.5 * (double(density[j * columns + i - 1]) + double(density[j * columns + i]));
        if (j > 0) across[j] = across[j - 1] + 0.5 * (along[j * columns - 1] + along[(j + 1) * columns - 1]);
      }
      const double scale = 1 / across[rows - 1];
      for (std::size_t k = 0; k < rows * columns; ++k) along[k] *= scale, density[k] = float(double(density[k]) * scale);
      for (std::size_t j = 0; j < rows; ++j) across[j] *= scale;
    }
  }

  void eval(const Direction& wi, const Direction& wo, double* f) const {
    const double theta_i = elevation(wi.x(), wi.y(), wi.z()), phi_i = std::atan2(wi.y(), wi.x());
    const double x = wi.x() + wo.x(), y = wi.y() + wo.y(), z = wi.z() + wo.z(), length = std::sqrt(x * x + y * y + z * z);
    const double mx = theta_to_u(elevation(x / length, y / length, z / length)), my = phi_to_u(std::atan2(y, x) - phi_i);
    const auto above = std::upper_bound(a_.theta_i.begin(), a_.theta_i.end() - 1, float(theta_i));
    const std::size_t high = std::size_t(above - a_.theta_i.begin()), slices[2] = {high - 1, high};
    const double part = std::clamp((theta_i - double(a_.theta_i[high - 1])) / double(a_.theta_i[high] - a_.theta_i[high - 1]), 0.0, 1.0);
    const double weight[2] = {1 - part, part};

    const std::size_t rows = a_.vndf_rows, columns = a_.vndf_columns;
    const auto mixed = [&](const auto& values, std::size_t stride, std::size_t at) {
      return weight[0] * double(values[slices[0] * stride + at]) + weight[1] * double(values[slices[1] * stride + at]);
    };
    const std::size_t i = cell(mx, columns), j = cell(my, rows);
    const double fx = mx * double(columns - 1) - double(i), fy = my * double(rows - 1) - double(j);
    const auto density = [&](std::size_t row, std::size_t column) { return mixed(a_.vndf, rows * columns, row * columns + column); };
    const auto along = [&](std::size_t row, std::size_t column) { return mixed(along_, rows * columns, row * columns + column); };
    const double low = along(j, columns - 1), up = along(j + 1, columns - 1);
    const double sy = mixed(across_, rows, j) + fy * (low + 0.5 * fy * (up - low));
    const double first = (1 - fy) * density(j, i) + fy * density(j + 1, i),
                 last = (1 - fy) * density(j, i + 1) + fy * density(j + 1, i + 1);
    const double sx =
        ((1 - fy) * along(j, i) + fy * along(j + 1, i) + fx * (first + 0.5 * fx * (last - first))) / ((1 - fy) * low + fy * up);

    const double scale = grid(a_.ndf.data(), a_.angle_rows, a_.angle_columns, mx, my) /
                         (4 * grid(a_.sigma.data(), a_.angle_rows, a_.angle_columns, theta_to_u(theta_i), phi_to_u(phi_i)) * wo.z());
    const std::size_t plane = a_.value_rows * a_.value_columns, channels = a_.channels.size();
    for (std::size_t c = 0; c < channels; ++c) {
      f[c] = 0;
      for (std::size_t n = 0; n < 2; ++n)
        f[c] += scale * weight[n] * grid(a_.values.data() + (slices[n] * channels + c) * plane, a_.value_rows, a_.value_columns, sx, sy);
    }
  }

 private:
  static double elevation(double x, double y, double z) { return 2 * std::asin(0.5 * std::sqrt(x * x + y * y + (z - 1) * (z - 1))); }
  static double theta_to_u(double theta) { return std::sqrt(theta * 2 / std::numbers::pi); }
  static double phi_to_u(double phi) {
    const double u = (phi + std::numbers::pi) / (2 * std::numbers::pi);
    return u - std::floor(u);
  }
  static std::size_t cell(double at, std::size_t nodes) { return std::min(std::size_t(at * double(nodes - 1)), nodes - 2); }
  static double grid(const float* values, std::size_t rows, std::size_t columns, double x, double y) {
    const std::size_t i = cell(x, columns), j = cell(y, rows);
    const double fx = x * double(columns - 1) - double(i), fy = y * double(rows - 1) - double(j);
    const float* v = values + j * columns + i;
    return (1 - fy) * ((1 - fx) * double(v[0]) + fx * double(v[1])) + fy * ((1 - fx) * double(v[columns]) + fx * double(v[columns + 1]));
  }

  RglArrays a_;
  std::vector<double> along_, across_;
};

}  // namespace

int main() {
  constexpr int runs = 9;
  const test::TemporaryFolder folder;
  Opened source;
  source.format = "model";
  source.brdf = std::make_shared<AnalyticBrdf>("ggx", rgb_channels(), std::vector<std::vector<double>>(3, {0.1, 0.6, 1, 0.15}));
  for (const bool spectral : {false, true}) {
    const char* const name = spectral ? "spectral.bsdf" : "rgb.bsdf";
    const auto write = spectral ? write_rgl_spectral : write_rgl_rgb;
    std::vector<double> seconds;
    for (int k = 0; k < runs; ++k) {
      const auto start = Clock::now();
      write(source, folder / name, {});
      seconds.push_back(seconds_since(start));
    }
    fmt::print("write {:<14} {:9} bytes, {:.0f} ms on 2 threads (median of {})\n", name, std::filesystem::file_size(folder / name),
               1e3 * median(seconds), runs);
  }

  constexpr std::size_t pairs = 200000;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto direction = [&] {
    const double z = 0.1 + 0.9 * uniform(random), phi = 2 * std::numbers::pi * uniform(random), r = std::sqrt(1 - z * z);
    return Direction::trusted(r * std::cos(phi), r * std::sin(phi), z);
  };
  std::vector<Direction> wi, wo;
  for (std::size_t k = 0; k < pairs; ++k) wi.push_back(direction()), wo.push_back(direction());
  const RglArrays arrays = read_rgl(folder / "rgb.bsdf");
  const RglTable table(arrays);
  const DirectRgl direct(arrays);
  std::vector<double> ours(3 * pairs), theirs(3 * pairs), our_s, direct_s;
  for (int k = 0; k < runs; ++k) {
    double start = cpu_seconds();
    for (std::size_t n = 0; n < pairs; ++n) direct.eval(wi[n], wo[n], theirs.data() + 3 * n);
    direct_s.push_back(cpu_seconds() - start);
    start = cpu_seconds();
    table.eval(wi, wo, ours);
    our_s.push_back(cpu_seconds() - start);
  }
  double worst = 0;
  for (std::size_t k = 0; k < ours.size(); ++k) worst = std::max(worst, std::fabs(ours[k] / theirs[k] - 1));
  fmt::print("look-up: {:.0f} ns, direct transcription {:.0f} ns: {:.2f} times as fast; largest relative difference {:.1e}\n",
             1e9 * median(our_s) / pairs, 1e9 * median(direct_s) / pairs, median(direct_s) / median(our_s), worst);
  return 0;
}
