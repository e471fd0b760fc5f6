// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/pair_coordinates.hpp"

#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

PairPoint at(double theta_i, double phi_i, double theta_o, double phi_o, bool isotropic) {
  return pair_point(Direction::spherical(degrees(theta_i), degrees(phi_i)), Direction::spherical(degrees(theta_o), degrees(phi_o)),
                    isotropic);
}

}  // namespace

TEST_CASE("s vanishes at the mirror direction of every incidence, and only there") {
  for (const double theta : {0.0, 20.0, 60.0, 89.0}) {
    const PairPoint mirror = at(theta, 40, theta, 220, false);
    CHECK(std::hypot(mirror[0], mirror[1]) < 1e-14);
  }
  CHECK(std::hypot(at(20, 0, 21, 180, false)[0], 0) > 0.01);
}

TEST_CASE("A step in elevation is as long at grazing as at the normal, within a third") {
  const auto step = [](double theta) { return std::sqrt(squared_distance(at(30, 0, theta, 0, true), at(30, 0, theta + 1, 0, true))); };
  CHECK(step(88) / step(0) > 0.67);
  // The plain projection on the surface would leave a hundredth of it.
  CHECK((std::sin(1.55334) - std::sin(1.53589)) / std::sin(0.0174533) < 0.03);
}

TEST_CASE("A turned isotropic pair is the same point, a turned anisotropic one is not") {
  const PairPoint a = at(35, 0, 50, 130, true), turned = at(35, 77, 50, 207, true);
  CHECK(squared_distance(a, turned) < 1e-28);
  CHECK(squared_distance(at(35, 0, 50, 130, false), at(35, 77, 50, 207, false)) > 0.1);
  CHECK(squared_distance(at(0, 0, 50, 10, true), at(0, 0, 50, 200, true)) < 1e-28);
}
