// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/tilt.hpp"

#include <cmath>
#include <numbers>

#include "fitting/checks/paired_places.hpp"
#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// In-plane and near-plane partners under a sample whose normal is tilted, as contrasts.
Contrasts tilted_pairs(const AnalyticBrdf& truth, double x_deg, double y_deg, TiltFrame frame, double turn_deg) {
  std::vector<GonioAngles> angles;
  for (double a = 10; a <= 60; a += 10)
    for (double b = 10; b <= 60; b += 10)
      for (const double phi : {165., 180., 195.})
        if (a != b) angles.push_back({degrees(a), degrees(turn_deg), degrees(b), degrees(turn_deg + phi)});
  auto data = readings(truth, angles, {0, 0, .002}, 9);
  for (std::size_t k = 0; k < data->size(); ++k) {
    const double ratio = truth.eval(seen_by_tilted(angles[k], frame, x_deg * degree, y_deg * degree))[0] / truth.eval(angles[k])[0];
    data->f[0][k] *= ratio, data->u[0][k] *= ratio;
  }
  Contrasts set;
  add_pairs(
      {data}, {key_turned, exchanged}, [](const GonioAngles&, double) { return std::vector<double>{}; }, set);
  return set;
}

}  // namespace

TEST_CASE("The tilted sample sees its own normal upright") {
  const GonioAngles along{degrees(7), degrees(0), degrees(7), degrees(90)};
  CHECK(seen_by_tilted(along, TiltFrame::sample, 7 * degree, 0).theta_i.degrees() == Approx(0).margin(1e-12));
  CHECK(seen_by_tilted(along, TiltFrame::sample, 0, 7 * degree).theta_o.degrees() == Approx(0).margin(1e-12));
  CHECK(seen_by_tilted({degrees(7), degrees(33), {}, {}}, TiltFrame::plane_of_incidence, 7 * degree, 0).theta_i.degrees() ==
        Approx(0).margin(1e-12));
}

TEST_CASE("A tilt is estimated with its uncertainty and taken out, in either frame and far beyond the linear range") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .3, 500);
  for (const TiltFrame frame : {TiltFrame::sample, TiltFrame::plane_of_incidence})
    for (const double size : {.05, 1.}) {
      const Contrasts set = tilted_pairs(truth, size, -size / 2, frame, 40);
      const auto tilt = estimate_tilt(set, truth, frame);
      REQUIRE(tilt);
      CHECK(std::abs(tilt->x_deg - size) < 4 * tilt->u_x_deg);
      CHECK(std::abs(tilt->y_deg + size / 2) < 4 * tilt->u_y_deg);
      const ContrastTest before = test_contrasts(set, .02, .01), after = test_contrasts(tilt->corrected, .02, .01);
      CHECK(before.chi2 / before.dof > 10);
      CHECK(after.chi2 / after.dof < 2);
      CHECK(after.dof == Approx(before.dof - 2).margin(.01));
    }
}

TEST_CASE("A model without slope gives no tilt") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .3, 500), flat("lambert", single_channel("Y"), {{.3}});
  const auto tilt = estimate_tilt(tilted_pairs(truth, .05, 0, TiltFrame::sample, 0), flat, TiltFrame::sample);
  CHECK((!tilt || tilt->size_deg() < tilt->u_deg()));
}
