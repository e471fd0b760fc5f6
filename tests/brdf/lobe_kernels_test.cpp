// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/lobe_kernels.hpp"

#include <cmath>
#include <numbers>

#include "brdf/coordinates.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

template <class T>
Vector3<T> vector(const Direction& w) {
  return {static_cast<T>(w.x()), static_cast<T>(w.y()), static_cast<T>(w.z())};
}

template <class To, class From>
Vector3<To> as(const Vector3<From>& v) {
  return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}

/// exp(s log_cos) of both lobes in T against long double on the same rounded vectors, from the peak down to e^-8 of it.
template <class T>
double worst_lobe_error(double s) {
  double worst = 0;
  for (int k = 0; k <= 16; ++k) {
    const double theta_h = std::sqrt(k / s);
    const DirectionPair pair = directions({radians(theta_h), radians(0.4), radians(0.8), radians(1.0)});
    const auto i = vector<T>(pair.wi), o = vector<T>(pair.wo);
    const auto il = as<long double>(i), ol = as<long double>(o);
    const long double half = std::exp(static_cast<long double>(s) * log_cos_half(il, ol));
    const long double mirror = std::exp(static_cast<long double>(s) * log_cos_mirror(il, ol));
    worst = std::fmax(worst, static_cast<double>(std::fabs(std::exp(static_cast<T>(s) * log_cos_half(i, o)) / half - 1)));
    if (mirror > 1e-20L)
      worst = std::fmax(worst, static_cast<double>(std::fabs(std::exp(static_cast<T>(s) * log_cos_mirror(i, o)) / mirror - 1)));
  }
  return worst;
}

}  // namespace

TEST_CASE("lobes near their peak are good to a few roundings for every exponent, in float too") {
  for (const double s : {1.0, 1e3, 1e6, 1e9}) {
    INFO("s " << s);
    CHECK(worst_lobe_error<float>(s) < 5e-6);  // exponents down to about -40: forty roundings of a float
    CHECK(worst_lobe_error<double>(s) < 1e-14);
  }
}

TEST_CASE("the stable forms are the plain ones where those are good") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  for (int k = 0; k < 200; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const auto i = vector<long double>(wi), o = vector<long double>(wo);
    const long double x = i.x + o.x, y = i.y + o.y, z = i.z + o.z, length = std::sqrt(x * x + y * y + z * z);
    constexpr double angles_of_doubles = 1e-13;
    CHECK(static_cast<double>(log_cos_half(i, o)) == Approx(static_cast<double>(std::log(z / length))).margin(angles_of_doubles));
    CHECK(static_cast<double>(theta_half(i, o)) == Approx(static_cast<double>(std::acos(z / length))).margin(1e-9));
    CHECK(static_cast<double>(theta_difference(i, o)) ==
          Approx(static_cast<double>(std::acos((i.x * x + i.y * y + i.z * z) / length))).margin(1e-9));
    const long double cos_psi = i.z * o.z - i.x * o.x - i.y * o.y;
    if (cos_psi > 0.01L) CHECK(static_cast<double>(log_cos_mirror(i, o)) == Approx(static_cast<double>(std::log(cos_psi))).margin(1e-12));
  }
}

TEST_CASE("θh of grazing mirrored pairs is atan(1/2), which vectors in float cannot hold") {
  for (const float elevation : {1e-4f, 1e-6f, 1e-8f}) {
    CHECK(theta_half_from_elevations(elevation, elevation, elevation) == Approx(std::atan(0.5)).epsilon(1e-6));
    CHECK(theta_half_from_elevations<double>(elevation, elevation, elevation) == Approx(std::atan(0.5)).epsilon(1e-8));
  }
  const float e = 1e-8f, azimuth = std::numbers::pi_v<float> - e;
  const Vector3<float> i{std::cos(e), 0, std::sin(e)}, o{std::cos(e) * std::cos(azimuth), std::cos(e) * std::sin(azimuth), std::sin(e)};
  CHECK(std::fabs(theta_half(i, o) - std::atan(0.5f)) > 0.3f);
}

TEST_CASE("an exponential below the normal numbers of its type is 0") {
  CHECK(lobe_exponential(-88.0f) == 0);
  CHECK(lobe_exponential(-701.0) == 0);
  CHECK(lobe_exponential(-80.0f) > 0);
}
