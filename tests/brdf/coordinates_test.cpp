// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/coordinates.hpp"

#include <numbers>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {
constexpr double pi = std::numbers::pi;
double circular(double a, double b, double length) { return std::fabs(std::remainder(a - b, length)); }
}  // namespace

TEST_CASE("half/difference coordinates from angles and from vectors agree") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  // Vectors lose digits at grazing (1e-16 over an elevation of 1e-6): the comparison is made above 1 degree of elevation.
  constexpr double vector_rounding = 1e-12;
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const GonioAngles a{degrees(test::uniform(random, 1, 89)), degrees(test::uniform(random, -180, 180)),
                        degrees(test::uniform(random, 1, 89)), degrees(test::uniform(random, -180, 180))};
    const HalfDifference from_angles = half_difference(a), from_vectors = half_difference(a.wi(), a.wo());
    worst = std::fmax(worst, std::fabs(from_angles.theta_h.radians() - from_vectors.theta_h.radians()));
    worst = std::fmax(worst, std::fabs(from_angles.theta_d.radians() - from_vectors.theta_d.radians()));
    const double size = from_angles.theta_h.sin() * from_angles.theta_d.sin();  // azimuths count only as far as they move a direction
    worst = std::fmax(worst, size * circular(from_angles.phi_h.radians(), from_vectors.phi_h.radians(), 2 * pi));
    worst = std::fmax(worst, size * circular(from_angles.phi_d.radians(), from_vectors.phi_d.radians(), 2 * pi));
  }
  CHECK(worst < vector_rounding);
}

TEST_CASE("directions come back from their half/difference coordinates") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  constexpr double rounding_only = 1e-14;
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const DirectionPair back = directions(half_difference(wi, wo));
    worst = std::fmax(worst, std::hypot(back.wi.x() - wi.x(), back.wi.y() - wi.y(), back.wi.z() - wi.z()));
    worst = std::fmax(worst, std::hypot(back.wo.x() - wo.x(), back.wo.y() - wo.y(), back.wo.z() - wo.z()));
  }
  CHECK(worst < rounding_only);
}

TEST_CASE("exchanging the directions turns phi_d by 180 degrees and leaves the rest") {
  const GonioAngles a{60_deg, 20_deg, 10_deg, 250_deg}, exchanged{10_deg, 250_deg, 60_deg, 20_deg};
  const HalfDifference one = half_difference(a), other = half_difference(exchanged);
  constexpr double rounding_only = 1e-14;
  CHECK(std::fabs(one.theta_h.radians() - other.theta_h.radians()) < rounding_only);
  CHECK(std::fabs(one.theta_d.radians() - other.theta_d.radians()) < rounding_only);
  CHECK(circular(one.phi_h.radians(), other.phi_h.radians(), 2 * pi) < rounding_only);
  CHECK(circular(one.phi_d.radians() + pi, other.phi_d.radians(), 2 * pi) < rounding_only);
  CHECK(circular(fold_phi_d(one.phi_d.radians()), fold_phi_d(other.phi_d.radians()), pi) < rounding_only);
}

TEST_CASE("opposite grazing directions have no half vector and still give numbers") {
  const HalfDifference hd = half_difference(GonioAngles{90_deg, 0_deg, 90_deg, 180_deg});
  CHECK(hd.theta_h.radians() == 0);
  CHECK(hd.theta_d.degrees() == Approx(90));
  CHECK(std::isfinite(hd.phi_h.radians()));
  CHECK(std::isfinite(hd.phi_d.radians()));
}

TEST_CASE("phi_d folds into [0, pi)") {
  CHECK(fold_phi_d(-0.25) == Approx(pi - 0.25));
  CHECK(fold_phi_d(pi) == 0.0);
  CHECK(fold_phi_d(-1e-18) == 0.0);
  CHECK(fold_phi_d(3 * pi + 0.5) == Approx(0.5));
}
