// SPDX-License-Identifier: BSD-3-Clause
// Projected solid angle of a disc against its closed cases and against summation over the disc.
#include <cmath>
#include <numbers>

#include "acquisition/reduce.hpp"

#include "tests/check.hpp"

using namespace gonio;
using acquisition::projected_solid_angle;

namespace {

constexpr double pi = std::numbers::pi;

/// ∫ max(0, n·ω) dΩ by the midpoint rule over the disc in polar coordinates about its centre.
double summed(Angle theta, Angle half_angle, int rings, int sectors) {
  double sum = 0;
  for (int r = 0; r < rings; ++r) {
    const double a = half_angle.radians() * (r + 0.5) / rings;
    for (int s = 0; s < sectors; ++s) {
      const double z = std::cos(a) * theta.cos() - std::sin(a) * theta.sin() * std::cos(2 * pi * (s + 0.5) / sectors);
      sum += std::max(0.0, z) * std::sin(a);
    }
  }
  return sum * half_angle.radians() / rings * 2 * pi / sectors;
}

}  // namespace

TEST_CASE("a disc above the horizon has pi sin² a cos theta exactly") {
  for (const double theta : {0.0, 30.0, 60.0, 80.0, 89.5})
    CHECK(projected_solid_angle(degrees(theta), degrees(0.5)) ==
          Approx(pi * std::pow(degrees(0.5).sin(), 2) * degrees(theta).cos()).epsilon(1e-15));
}

TEST_CASE("a disc that the horizon cuts agrees with a sum over the disc") {
  for (const double a : {0.5, 2.0, 10.0, 45.0})
    for (const double beyond : {-0.9, -0.3, 0.0, 0.4, 0.9}) {
      const Angle theta = degrees(90 + beyond * a);
      INFO("half angle " << a << "°, theta " << theta.degrees() << "°");
      CHECK(projected_solid_angle(theta, degrees(a)) == Approx(summed(theta, degrees(a), 400, 4000)).epsilon(2e-4));
    }
}

TEST_CASE("half a disc at the horizon has a - sin a cos a, and none below it") {
  const double a = degrees(2.0).radians();
  CHECK(projected_solid_angle(90_deg, 2_deg) == Approx(a - std::sin(a) * std::cos(a)).epsilon(1e-12));
  CHECK(projected_solid_angle(92_deg, 2_deg) == 0);
  CHECK(projected_solid_angle(120_deg, 2_deg) == 0);
  CHECK(projected_solid_angle(30_deg, 0_deg) == 0);
}

TEST_CASE("the product form that ignores the horizon is wrong there") {
  const double product = pi * std::pow(degrees(2.0).sin(), 2) * degrees(89.0).cos();
  CHECK(projected_solid_angle(89_deg, 2_deg) > 1.05 * product);
}
