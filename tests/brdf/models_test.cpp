// SPDX-License-Identifier: BSD-3-Clause
// The laws every analytic model has to obey, run over the list.
#include "brdf/models.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr double pi = std::numbers::pi;

/// Parameters for tests: rho_d = 0.3, rho_s = 0.5, s as given.
template <class M>
std::array<double, M::parameters.size()> parameters(double s) {
  std::array<double, M::parameters.size()> values{};
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = M::parameters[k].linear ? 0.3 + 0.2 * static_cast<double>(k) : s;
  return values;
}

/// ∫ f cos θo dωo over the hemisphere by a product rule in (θo, φ) with nodes refined towards θo = 90°; good for smooth lobes.
template <class M>
double quadrature_albedo(Angle theta_i, const double* values) {
  constexpr int n = 400;
  double sum = 0;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double sin2 = (a + 0.5) / n, phi = 2 * pi * (b + 0.5) / n;  // uniform in sin²: the projected solid angle is constant
      const double r = std::sqrt(sin2);
      const Direction wo = Direction::trusted(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - sin2));
      sum += evaluate<M>(lobe_geometry(Direction::spherical(theta_i, 0_deg), wo), values);
    }
  return sum * pi / (double{n} * n);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a model is finite and not negative everywhere, grazing included", "[models]", Models) {
  test::Random random(test::seed);
  INFO(TestType::name << ", seed " << test::seed);
  int bad = 0;
  for (const double s : {0.0, 1e-3, 1.0, 50.0, 1e5, 1e9}) {
    const auto values = parameters<TestType>(s);
    for (int k = 0; k < 2000; ++k) {
      const double f = evaluate<TestType>(lobe_geometry(test::gonio_pair(random)), values.data());
      bad += !(std::isfinite(f) && f >= 0);
    }
  }
  CHECK(bad == 0);
}

TEMPLATE_LIST_TEST_CASE("a model that says it is reciprocal is so to the last bit", "[models]", Models) {
  test::Random random(test::seed);
  INFO(TestType::name << ", seed " << test::seed);
  if (!TestType::properties.reciprocal) {
    SUCCEED("does not claim it");
    return;
  }
  int different = 0;
  const auto values = parameters<TestType>(37.5);
  for (int k = 0; k < 5000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    different += evaluate<TestType>(lobe_geometry(wi, wo), values.data()) != evaluate<TestType>(lobe_geometry(wo, wi), values.data());
  }
  CHECK(different == 0);
}

TEST_CASE("the reciprocity law refuses a lobe divided by one cosine") {
  // Phong's shading formula read as a BRDF: the gate above must be able to fail.
  const Direction wi = Direction::spherical(30_deg, 0_deg), wo = Direction::spherical(50_deg, 180_deg);
  const auto shading = [](const LobeGeometry& g) { return cosine_power(g.log_cos_psi, 10.0) / g.cos_i; };
  CHECK(shading(lobe_geometry(wi, wo)) != shading(lobe_geometry(wo, wi)));
}

TEMPLATE_LIST_TEST_CASE("the albedo of a model agrees with quadrature", "[models]", Models) {
  constexpr double quadrature_400 = 2e-3;  // midpoint rule with a kink at the horizon of the lobe
  for (const double s : {0.5, 8.764, 40.0})
    for (const double theta : {0.0, 35.0, 70.0}) {
      const auto values = parameters<TestType>(s);
      double albedo[4] = {};
      TestType::albedo(degrees(theta), values.data() + linear_count<TestType>(), albedo);
      double total = 0;
      for (std::size_t k = 0; k < linear_count<TestType>(); ++k) total += values[k] * albedo[k];
      INFO(TestType::name << " s=" << s << " theta=" << theta);
      CHECK(quadrature_albedo<TestType>(degrees(theta), values.data()) == Approx(total).epsilon(quadrature_400));
    }
}

TEMPLATE_LIST_TEST_CASE("the albedo of a model never exceeds its bound, and reaches it", "[models]", Models) {
  for (const double s : {0.0, 0.1, 1.0, 8.764, 100.0, 1e4}) {
    double bound[4] = {}, largest[4] = {};
    TestType::albedo_bound(&s, bound);
    for (double theta = 0; theta <= 90; theta += 0.5) {
      double albedo[4] = {};
      TestType::albedo(degrees(theta), &s, albedo);
      for (std::size_t k = 0; k < linear_count<TestType>(); ++k) largest[k] = std::fmax(largest[k], albedo[k]);
    }
    for (std::size_t k = 0; k < linear_count<TestType>(); ++k) {
      INFO(TestType::name << " s=" << s << " basis " << k);
      CHECK(largest[k] == Approx(bound[k]).epsilon(1e-12));
    }
  }
}

TEMPLATE_LIST_TEST_CASE("a lobe is nothing where its cosine is not positive, at s = 0 too", "[models]", Models) {
  const auto values = parameters<TestType>(0);
  LobeGeometry g;
  g.log_cos_h = g.log_cos_psi = LobeGeometry::no_lobe;
  CHECK(evaluate<TestType>(g, values.data()) == Approx(0.3 / pi));
}

TEST_CASE("models have distinct names, citations and sound parameter tables") {
  std::set<std::string_view> names;
  for (const ModelInfo& info : model_infos()) {
    INFO(info.name);
    CHECK(names.insert(info.name).second);
    CHECK(info.citation.size() > 20);
    bool nonlinear_seen = false;
    for (const Parameter& p : info.parameters) {
      CHECK(p.lower < p.upper);
      CHECK_FALSE((p.linear && nonlinear_seen));
      nonlinear_seen = nonlinear_seen || !p.linear;
    }
  }
  CHECK(names.size() == 6);
}
