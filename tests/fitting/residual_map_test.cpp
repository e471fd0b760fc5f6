// SPDX-License-Identifier: BSD-3-Clause
// The map of residuals is flat for a model that fits and shows where another does not.
#include "fitting/residual_map.hpp"

#include <algorithm>
#include <cmath>

#include "brdf/aperture.hpp"
#include "fitting/fit.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// theta_o negative on the side of the light.
const ResidualCell& cell(const ResidualMap& map, double theta_i, double theta_o) {
  const GonioAngles angles{degrees(theta_i), degrees(0), degrees(std::abs(theta_o)), degrees(theta_o < 0 ? 0 : 180)};
  return map.channel[0][residual_cell(lobe_geometry(angles))];
}

}  // namespace

TEST_CASE("residuals of the right model have mean 0 and scatter 1 everywhere") {
  const auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({5, 25, 45, 65}, 5, 10), {1e-3, 0, .01}, 3);
  const ResidualMap map = fit(*observe(data), {}).residuals;
  CHECK(map.n_samples == data->size());
  std::size_t filled = 0;
  for (const ResidualCell& c : map.channel[0]) {
    if (c.count < 30) continue;
    ++filled;
    const double n = static_cast<double>(c.count);
    CHECK(std::abs(c.mean) < 4.5 / std::sqrt(n));  // 4.5: one of 40 cells beyond it in a draw of 4000
    CHECK(std::abs(c.rms - 1) < 4.5 / std::sqrt(2 * n));
  }
  CHECK(filled >= 56);
}

TEST_CASE("a diffuse fit of a lobe shows it where it is") {
  const auto observations = observe(readings(lobe("blinn-phong", .2, .3, 20), polar_grid({45}, 5, 10), {1e-3, 0, 0}, 3));
  FitOptions options;
  options.model = "lambert";
  const ResidualMap map = fit(*observations, options).residuals;
  CHECK(cell(map, 45, 45).rms > 10);
  double least = 0;
  for (const ResidualCell& c : map.channel[0]) least = std::min(least, c.mean);
  CHECK(least < -3);
  CHECK(cell(map, 5, 5).count == 0);
}

TEST_CASE("without any uncertainty the residuals are scaled by their own root mean square") {
  auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({5, 25, 45, 65}, 5, 10), {1e-3, 0, 0}, 3);
  data->u.clear();
  FitOptions options;
  options.metric = Metric::linear;
  const auto observations = observe(data);
  const ResidualMap map = fit(*observations, options).residuals;
  double square = 0, count = 0;
  for (const ResidualCell& c : map.channel[0])
    square += static_cast<double>(c.count) * c.rms * c.rms, count += static_cast<double>(c.count);
  CHECK(square / count == Approx(1));
}

TEST_CASE("the sides of the light and of the mirror direction are told apart, and the steps end below their multiples") {
  const auto cell_of = [](double theta_i, double theta_o, double phi) {
    return residual_cell(lobe_geometry({degrees(theta_i), degrees(0), degrees(theta_o), degrees(phi)}));
  };
  CHECK(ResidualMap::theta_i_deg(cell_of(30, 50, 180)) == 35);
  CHECK(ResidualMap::theta_o_deg(cell_of(30, 50, 180)) == 55);
  CHECK(ResidualMap::theta_o_deg(cell_of(30, 50, 0)) == -55);
  CHECK(ResidualMap::theta_o_deg(cell_of(30, 50, 90)) == 55);
  CHECK(cell_of(29.9, 50, 91) == cell_of(30.1, 50.1, 180));
  CHECK(cell_of(29.9, 50, 89) == cell_of(30, 49.9, 10));
  CHECK(ResidualMap::theta_o_deg(cell_of(30, 0, 0)) == 5);
  CHECK(ResidualMap::theta_i_deg(cell_of(90, 90, 180)) == 85);
  CHECK(ResidualMap::theta_o_deg(cell_of(90, 90, 0)) == -85);
}

TEST_CASE("errors and residuals are those of the means over apertures that were fitted") {
  constexpr double noise = 1e-3, half_angle = .5;
  auto data = readings(lobe("blinn-phong", .2, .3, 1e4), polar_grid({30}, 1, 10), {noise, 0, 0}, 3);
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .3, 1e4);
  for (std::size_t k = 0; k < data->size(); ++k) {
    double mean = 0;
    for (const AperturePair& pair : aperture_pairs(data->angles[k], {0, half_angle * 3.14159265358979 / 180, 0, 8}))
      mean += pair.weight * truth.eval(pair.wi, pair.wo)[0];
    data->f[0][k] += mean - truth.eval(data->angles[k])[0];
  }
  data->apertures.source_half_angle_deg = 0;
  data->apertures.receiver_half_angle_deg = half_angle;
  const FitResult means = fit(*observe(data), {});
  REQUIRE(means.aperture.on);
  CHECK(means.values[0][2] == Approx(1e4).epsilon(.01));
  CHECK(means.errors.linear == Approx(noise).epsilon(.1));
  for (const ResidualCell& c : means.residuals.channel[0])
    if (c.count > 0) CHECK(std::abs(c.mean) < 4.5 / std::sqrt(static_cast<double>(c.count)));
  // The peak is lower by the mean; the same parameters at the nominal directions would miss it by many times the noise.
  FitOptions options;
  options.ignore_apertures = true;
  options.fixed = {{"rho_d", means.values[0][0]}, {"rho_s", means.values[0][1]}, {"s", means.values[0][2]}};
  const FitResult points = fit(*observe(data), options);
  CHECK(points.errors.linear > 10 * noise);
}

TEST_CASE("where more outliers are left out than listed, none of them is in the map") {
  auto data = readings(lobe("blinn-phong", .2, .3, 20), polar_grid({5, 25, 45, 65}, .5, 2), {1e-3, 0, .01}, 3);
  data->u.clear();
  std::size_t wrong = 0;
  for (std::size_t k = 50; k < data->size(); k += 97) data->f[0][k] *= 20, ++wrong;
  REQUIRE(wrong > Weighting::most_listed);
  const FitResult result = fit(*observe(data), {});
  CHECK(result.weighting.n_outliers > Weighting::most_listed);
  for (const ResidualCell& c : result.residuals.channel[0])
    if (c.count > 100) CHECK(c.rms < 1.3);
}
