// SPDX-License-Identifier: BSD-3-Clause
// On a whole gantry's grid, without stated uncertainties: the tilt's sigma, and intervals beside it, over many draws.
#include <array>
#include <cmath>
#include <numbers>

#include "fitting/fit.hpp"
#include "fitting/misalignment.hpp"
#include "tests/fitting/ngan_grid.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("over 100 draws of a tilted sample of s = 2000 the sigma of the tilt and the intervals of the model are right") {
  constexpr double degree = std::numbers::pi / 180;
  constexpr int draws = 100;
  const std::vector<GonioAngles> angles = gantry_grid();
  const Misalignment m{.5 * degree, -.3 * degree, 0};
  std::vector<GonioAngles> seen;
  for (const GonioAngles& a : angles) seen.push_back(seen_by(m, a));
  const NoisyReadings readings(ngan_material(2000), seen);
  FitOptions options;
  options.model = "blinn-phong-ngan";
  options.nuisance.tilt = true;
  std::array<double, 2> z2{};
  int held = 0, wide = 0, beyond = 0, counted = 0;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    auto data = readings.draw(seed);
    data->angles = angles;
    const FitResult result = fit(*observe(data), options);
    REQUIRE(result.nuisance.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      const NuisanceParameter& p = result.nuisance[k];
      REQUIRE(p.sigma);
      const double z = (p.value - (k == 0 ? .5 : -.3)) / *p.sigma;
      z2[k] += z * z;
      beyond += std::abs(z) > 3;
    }
    for (const FittedParameter& p : result.parameters) {
      const double truth = p.name == "s" ? 2000 : p.name == "rho_s" ? .3 : *p.channel == 0 ? .2 : *p.channel == 1 ? .15 : .1;
      REQUIRE(p.kind == IntervalKind::interval);
      held += *p.low <= truth && truth <= *p.high;
      wide += (p.value + *p.low) / 2 <= truth && truth <= (p.value + *p.high) / 2;
      ++counted;
    }
  }
  const double coverage = static_cast<double>(held) / counted;
  WARN("rms z of the tilt " << std::sqrt(z2[0] / draws) << ", " << std::sqrt(z2[1] / draws) << "; " << beyond << " of " << 2 * draws
                            << " beyond 3; 95 % intervals hold " << 100 * coverage << " % of " << counted);
  // The rms of 100 normal numbers lies in 0.82 … 1.18 but for a probability of 1 %.
  for (const double sum : z2) CHECK(std::sqrt(sum / draws) == Approx(1).margin(.2));
  CHECK(beyond <= 4);
  CHECK(coverage >= .91);
  CHECK(coverage <= .98);
  // The gate: intervals of half the width.
  CHECK(wide < .91 * counted);
}
