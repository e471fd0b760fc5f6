// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/direction_table.hpp"

#include <cmath>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

AnalyticBrdf model() { return AnalyticBrdf("blinn-phong", single_channel("value"), {{0.3, 0.2, 5}}); }

std::shared_ptr<Dataset> grid(bool isotropic) {
  auto out = std::make_shared<Dataset>();
  out->channels = single_channel("value");
  out->symmetry.isotropic = isotropic;
  out->f.resize(1);
  for (int i = 5; i < 80; i += 10)
    for (int o = 5; o < 80; o += 5)
      for (int phi = 0; phi < 360; phi += 15) {
        out->angles.push_back({degrees(i), degrees(0), degrees(o), degrees(phi)});
        out->f[0].push_back(model().eval(out->angles.back())[0]);
      }
  return out;
}

}  // namespace

TEST_CASE("Every measured direction gives its own value, turned too where the data are isotropic") {
  const auto data = grid(true);
  const DirectionTable table(data);
  double worst = 0;
  for (std::size_t k = 0; k < data->size(); ++k) {
    const GonioAngles& a = data->angles[k];
    const GonioAngles turned{a.theta_i, a.phi_i + degrees(33), a.theta_o, a.phi_o + degrees(33)};
    for (const GonioAngles& at : {a, turned}) worst = std::max(worst, std::fabs(table.eval(at.wi(), at.wo())[0] / data->f[0][k] - 1));
  }
  CHECK(worst < 1e-14);
  // Without the flag a turned pair is another pair, and 33 degrees away there is no sample.
  CHECK(std::isnan(DirectionTable(grid(false)).eval(Direction::spherical(75_deg, 33_deg), Direction::spherical(70_deg, 213_deg))[0]));
}

TEST_CASE("Bilateral data on one side of the plane of incidence are known on both") {
  const auto whole = grid(true);
  auto half = std::make_shared<Dataset>(*whole);
  half->angles.clear(), half->f[0].clear();
  for (const GonioAngles& at : whole->angles)
    if (at.phi_o.degrees() <= 180) half->angles.push_back(at), half->f[0].push_back(model().eval(at)[0]);
  const Direction wi = Direction::spherical(35_deg, 0_deg), other = Direction::spherical(70_deg, 270_deg);
  CHECK(std::isnan(DirectionTable(half).eval(wi, other)[0]));
  half->symmetry.bilateral = true;
  CHECK(DirectionTable(half).eval(wi, other)[0] == DirectionTable(half).eval(wi, Direction::spherical(70_deg, 90_deg))[0]);
}

TEST_CASE("Between samples the value stays near the function that was sampled") {
  const DirectionTable table(grid(true));
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  constexpr double coarse_grid = 0.15;  // 10 x 5 x 15 degrees on a lobe of s = 5
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    if (wi.z() < 0.3 || wo.z() < 0.3) continue;
    worst = std::max(worst, std::fabs(table.eval(wi, wo)[0] / model().eval(wi, wo)[0] - 1));
  }
  CHECK(worst < coarse_grid);
}

TEST_CASE("Below the horizon the table is 0, far from every sample it is unknown") {
  const DirectionTable table(grid(false));
  CHECK(table.eval(Direction::spherical(30_deg, 0_deg), Direction::spherical(95_deg, 180_deg))[0] == 0);
  CHECK(std::isnan(table.eval(Direction::spherical(60_deg, 120_deg), Direction::spherical(40_deg, 0_deg))[0]));
}
