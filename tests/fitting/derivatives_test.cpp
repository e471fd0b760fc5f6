// SPDX-License-Identifier: BSD-3-Clause
// Automatic derivatives of every model of the list against differences, at degenerate geometry too.
#include <algorithm>
#include <cmath>
#include <vector>

#include "fitting/model_kernel.hpp"
#include "tests/brdf/model_parameters.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

/// Random pairs, then the peak, grazing, the horizon, no half vector, retro-reflection.
std::vector<LobeGeometry> geometry() {
  test::Random random(test::seed);
  std::vector<LobeGeometry> out;
  for (int k = 0; k < 60; ++k) out.push_back(lobe_geometry(test::gonio_pair(random)));
  const auto add = [&](double theta_i, double theta_o, double phi) {
    out.push_back(lobe_geometry(GonioAngles{degrees(theta_i), 20_deg, degrees(theta_o), degrees(phi + 20)}));
  };
  add(0, 0, 0), add(40, 40, 180), add(40, 41, 180), add(89.99, 89.9, 180), add(90, 90, 0), add(90, 90, 180), add(90, 30, 50);
  add(80, 80, 0), add(0, 90, 0), add(40, 40, 0);
  return out;
}

/// Rounding of the difference and the second derivative, of a basis function as large as `scale`; a power with a large exponent loses the
/// digits of the exponent.
bool agree(double derivative, double difference, double step, double scale, double exponent) {
  const double rounding = 1e-12 * (1 + 1e-3 * exponent);
  return std::abs(derivative - difference) <= 1e-4 * std::abs(difference) + rounding * scale / step + 1e-7 * scale;
}

}  // namespace

TEST_CASE("derivatives of every basis function in every nonlinear parameter are finite and agree with differences") {
  const std::vector<LobeGeometry> places = geometry();
  const std::size_t rows = places.size();
  for (const ModelInfo& info : model_infos()) {
    const ModelKernel kernel = model_kernel(info.name);
    for (const std::vector<double>& values : test::parameter_settings(info)) {
      std::vector<double> nonlinear(values.begin() + static_cast<std::ptrdiff_t>(info.linear_count), values.end());
      std::vector<double> columns(kernel.linear * rows), slopes(kernel.nonlinear * kernel.linear * rows), plain(columns), low(columns),
          high(columns);
      kernel.basis_and_slopes(places, nonlinear.data(), columns.data(), slopes.data(), rows);
      kernel.basis(places, nonlinear.data(), plain.data(), rows);
      INFO(info.name);
      std::size_t different = 0;  // automatic differentiation divides by multiplying with the reciprocal
      for (std::size_t k = 0; k < plain.size(); ++k) different += columns[k] != Approx(plain[k]).epsilon(1e-12);
      CHECK(different == 0);
      double exponent = 0;
      for (const double value : nonlinear) exponent = std::max(exponent, std::min(std::abs(value), 1e9));
      for (std::size_t j = 0; j < kernel.nonlinear; ++j) {
        const Parameter& p = info.parameters[kernel.linear + j];
        const double step = 1e-6 * std::max(std::abs(nonlinear[j]), p.axis == Parameter::Axis::linear ? 1e-2 * (p.upper - p.lower) : 0.0);
        std::vector<double> below = nonlinear, above = nonlinear;
        below[j] -= step, above[j] += step;
        if (step == 0 || below[j] < p.lower || above[j] > p.upper) continue;
        kernel.basis(places, below.data(), low.data(), rows);
        kernel.basis(places, above.data(), high.data(), rows);
        std::size_t bad = 0;
        for (std::size_t k = 0; k < kernel.linear; ++k)
          for (std::size_t row = 0; row < rows; ++row) {
            const double derivative = slopes[(j * kernel.linear + k) * rows + row];
            const double difference = (high[k * rows + row] - low[k * rows + row]) / (above[j] - below[j]);
            const double scale = std::max(std::abs(plain[k * rows + row]), std::abs(difference) * step);
            bad += !std::isfinite(derivative) || !agree(derivative, difference, step, scale, exponent);
          }
        INFO(p.name << " = " << nonlinear[j]);
        CHECK(bad == 0);
      }
      const bool finite = std::all_of(slopes.begin(), slopes.end(), [](double slope) { return std::isfinite(slope); });
      CHECK(finite);
    }
  }
}
