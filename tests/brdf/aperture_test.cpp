// SPDX-License-Identifier: BSD-3-Clause
// Means over apertures: exact for polynomials, right for lobes, and what they do to a peak.
#include "brdf/aperture.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "brdf/models.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

double mean_phong(const GonioAngles& angles, const ApertureRule& rule, double s) {
  std::vector<LobeGeometry> geometry;
  std::vector<double> weight;
  aperture_nodes(angles, rule, geometry, weight);
  double mean = 0;
  for (std::size_t k = 0; k < geometry.size(); ++k) mean += weight[k] * cosine_power(geometry[k].log_cos_psi, s);
  return mean;
}

constexpr double half_degree = 0.5 * std::numbers::pi / 180;

}  // namespace

TEST_CASE("a disc rule of order m is exact for polynomials of degree 4m - 1") {
  for (int order = 0; order <= 6; ++order) {
    const auto rule = disc_rule(order);
    CHECK(rule.size() == (order == 0 ? 1u : static_cast<std::size_t>(4 * order * order)));
    for (int a = 0; a <= 4 * order; ++a)
      for (int b = 0; a + b <= std::max(0, 4 * order - 1); ++b) {
        double sum = 0;
        for (const DiscNode& node : rule)
          sum += node.weight * std::pow(node.radius * std::cos(node.azimuth), a) * std::pow(node.radius * std::sin(node.azimuth), b);
        // Mean of x^a y^b over the unit disc: 0 for odd powers, else 2/(a+b+2) B((a+1)/2, (b+1)/2)/π.
        const double exact = a % 2 || b % 2 ? 0
                                            : 2.0 / (a + b + 2) * std::tgamma((a + 1) / 2.0) * std::tgamma((b + 1) / 2.0) /
                                                  std::tgamma((a + b) / 2.0 + 1) / std::numbers::pi;
        INFO(order << ' ' << a << ' ' << b);
        CHECK(sum == Approx(exact).margin(1e-14));
      }
  }
}

TEST_CASE("the peak of a mirror lobe falls by s a²/4, source and receiver in squares") {
  const GonioAngles peak{degrees(30), degrees(0), degrees(30), degrees(180)};
  const double s = 400, a = half_degree;
  const double drop = s * a * a / 4;
  CHECK(1 - mean_phong(peak, {0, a, 0, 2}, s) == Approx(drop).epsilon(.01));
  CHECK(1 - mean_phong(peak, {a, 0, 2, 0}, s) == Approx(drop).epsilon(.01));
  CHECK(1 - mean_phong(peak, {a, a, 2, 2}, s) == Approx(2 * drop).epsilon(.02));
  CHECK(mean_phong(peak, {a, a, 0, 0}, s) == 1);
}

TEST_CASE("rules of growing order agree with a Monte Carlo mean and with each other") {
  const GonioAngles beside{degrees(30), degrees(0), degrees(31.1), degrees(179)};
  const double s = 1e4;
  const double fine = mean_phong(beside, {0, half_degree, 0, 8}, s);
  CHECK(mean_phong(beside, {0, half_degree, 0, 2}, s) == Approx(fine).epsilon(2e-2));
  CHECK(mean_phong(beside, {0, half_degree, 0, 3}, s) == Approx(fine).epsilon(1e-3));
  CHECK(mean_phong(beside, {0, half_degree, 0, 4}, s) == Approx(fine).epsilon(1e-5));

  // The same mean from directions drawn uniformly over the cone, each with the weight cos θo.
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform;
  const Direction wi = beside.wi(), axis = beside.wo();
  double sum = 0, weights = 0;
  for (int k = 0; k < 400000;) {
    const double cosine = 1 - uniform(random) * (1 - std::cos(1.2 * half_degree)), phi = 2 * std::numbers::pi * uniform(random);
    const double sine = std::sqrt(1 - cosine * cosine);
    const Direction pole = Direction::spherical(radians(std::acos(cosine)), radians(phi));
    // Turn +z onto the axis about y, then about z; keep what lies in the cone.
    const double st = beside.theta_o.sin(), ct = beside.theta_o.cos(), sp = beside.phi_o.sin(), cp = beside.phi_o.cos();
    const double x = ct * pole.x() + st * pole.z(), z = -st * pole.x() + ct * pole.z();
    const Direction wo = Direction::trusted(cp * x - sp * pole.y(), sp * x + cp * pole.y(), z);
    ++k;
    if (sine > std::sin(half_degree) || dot(wo, axis) < std::cos(half_degree)) continue;
    sum += wo.z() * cosine_power(lobe_geometry(wi, wo).log_cos_psi, s);
    weights += wo.z();
  }
  CHECK(sum / weights == Approx(fine).epsilon(5e-3));  // 400 000 draws of values that spread by their own size
}

TEST_CASE("cones are cut at the horizon") {
  std::vector<LobeGeometry> geometry;
  std::vector<double> weight;
  const std::size_t nodes = aperture_nodes({degrees(10), degrees(0), degrees(90), degrees(0)}, {0, half_degree, 0, 2}, geometry, weight);
  CHECK(nodes == 8);
  double sum = 0;
  for (const double w : weight) sum += w;
  CHECK(sum == Approx(1));
  for (const LobeGeometry& g : geometry) CHECK(g.cos_o > 0);
  CHECK(aperture_nodes({degrees(10), degrees(0), degrees(95), degrees(0)}, {0, half_degree, 0, 2}, geometry, weight) == 0);
}
