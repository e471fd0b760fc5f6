// SPDX-License-Identifier: BSD-3-Clause
// The laws every analytic model has to obey, run over the list.
#include "brdf/models.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "brdf/analytic_brdf.hpp"
#include "tests/brdf/model_parameters.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr double pi = std::numbers::pi;

/// ∫ f cos θo dωo over the hemisphere by a product rule in (θo, φ) with nodes refined towards θo = 90°; good for smooth lobes.
double quadrature_albedo(const ModelInfo& info, Angle theta_i, Angle phi_i, const double* values) {
  constexpr int n = 400;
  double sum = 0;
  const Direction wi = Direction::spherical(theta_i, phi_i);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double sin2 = (a + 0.5) / n, phi = 2 * pi * (b + 0.5) / n;  // uniform in sin²: the projected solid angle is constant
      const double r = std::sqrt(sin2);
      sum += info.evaluate(lobe_geometry(wi, Direction::trusted(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - sin2))), values);
    }
  return sum * pi / (double{n} * n);
}

std::string text(const std::vector<double>& values) {
  std::string out;
  for (const double value : values) out += std::to_string(value) + ' ';
  return out;
}

/// Pairs where a formula may divide by nothing: the peak, the horizon, both directions in the surface, retro-reflection.
std::vector<GonioAngles> degenerate_pairs() {
  std::vector<GonioAngles> out;
  for (const double theta_i : {0.0, 1e-8, 40.0, 89.9999999, 90.0})
    for (const double theta_o : {0.0, 1e-8, 40.0, 40.0000001, 89.9999999, 90.0})
      for (const double phi : {0.0, 1e-9, 90.0, 180.0}) out.push_back({degrees(theta_i), 0_deg, degrees(theta_o), degrees(phi)});
  return out;
}

}  // namespace

TEST_CASE("a model is finite and not negative everywhere, grazing and every end of its parameters included", "[models]") {
  for (const ModelInfo& info : model_infos()) {
    test::Random random(test::seed);
    for (const std::vector<double>& values : test::parameter_settings(info)) {
      int bad = 0;
      const auto check = [&](const LobeGeometry& g) {
        const double f = info.evaluate(g, values.data());
        bad += !(std::isfinite(f) && f >= 0);
        std::vector<double> columns(info.linear_count);  // the horizon takes the limit
        info.basis(std::span(&g, 1), values.data() + info.linear_count, columns.data(), 1);
        for (const double column : columns) bad += !(std::isfinite(column) && column >= 0);
      };
      for (int k = 0; k < 500; ++k) check(lobe_geometry(test::gonio_pair(random)));
      for (const GonioAngles& angles : degenerate_pairs()) check(lobe_geometry(angles)), check(lobe_geometry(angles.wi(), angles.wo()));
      INFO(info.name << " at " << text(values) << ", seed " << test::seed);
      CHECK(bad == 0);
    }
  }
}

TEST_CASE("a model that says it is reciprocal is so to the last bit", "[models]") {
  for (const ModelInfo& info : model_infos()) {
    if (!info.properties.reciprocal) continue;
    test::Random random(test::seed);
    INFO(info.name << ", seed " << test::seed);
    int different = 0;
    for (const std::vector<double>& values : test::parameter_settings(info))
      for (int k = 0; k < 500; ++k) {
        const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
        different += info.evaluate(lobe_geometry(wi, wo), values.data()) != info.evaluate(lobe_geometry(wo, wi), values.data());
      }
    CHECK(different == 0);
  }
}

TEST_CASE("the reciprocity law refuses a lobe divided by one cosine") {
  // Phong's shading formula read as a BRDF: the gate above must be able to fail.
  const Direction wi = Direction::spherical(30_deg, 0_deg), wo = Direction::spherical(50_deg, 180_deg);
  const auto shading = [](const LobeGeometry& g) { return cosine_power(g.log_cos_psi, 10.0) / g.cos_i; };
  CHECK(shading(lobe_geometry(wi, wo)) != shading(lobe_geometry(wo, wi)));
}

TEST_CASE("a model is isotropic and bilateral exactly if it says so", "[models]") {
  constexpr double turned_rounding = 1e-9;  // of the azimuths, times the slope of a lobe at its example width
  for (const ModelInfo& info : model_infos()) {
    test::Random random(test::seed);
    const std::vector<double> values = test::example_values(info);
    int turned = 0, mirrored = 0;
    for (int k = 0; k < 500; ++k) {
      GonioAngles a{degrees(test::uniform(random, 0, 80)), degrees(test::uniform(random, -180, 180)), degrees(test::uniform(random, 0, 80)),
                    degrees(test::uniform(random, -180, 180))};
      const double f = info.evaluate(lobe_geometry(a), values.data());
      GonioAngles turn = a, mirror = a;
      turn.phi_i = a.phi_i + 50_deg, turn.phi_o = a.phi_o + 50_deg;
      mirror.phi_o = a.phi_i + (a.phi_i - a.phi_o);  // mirrored at the plane of incidence
      turned += info.evaluate(lobe_geometry(turn), values.data()) != Approx(f).epsilon(turned_rounding);
      mirrored += info.evaluate(lobe_geometry(mirror), values.data()) != Approx(f).epsilon(turned_rounding);
    }
    INFO(info.name << ", seed " << test::seed);
    CHECK((turned == 0) == info.properties.isotropic);
    CHECK((mirrored == 0) == info.properties.bilateral);
  }
}

TEST_CASE("the closed albedo of a model agrees with quadrature", "[models]") {
  constexpr double quadrature_400 = 2e-3;  // midpoint rule with a kink at the horizon of the lobe
  for (const ModelInfo& info : model_infos()) {
    if (!info.closed_albedo) continue;
    for (const double stretch : {0.02, 0.22, 1.0})
      for (const double theta : {0.0, 35.0, 70.0}) {
        std::vector<double> values = test::example_values(info), albedo(info.linear_count);
        for (std::size_t k = info.linear_count; k < values.size(); ++k) values[k] *= stretch;
        info.albedo(degrees(theta), degrees(25), values.data() + info.linear_count, albedo.data());
        double total = 0;
        for (std::size_t k = 0; k < albedo.size(); ++k) total += values[k] * albedo[k];
        INFO(info.name << " at " << text(values) << " theta=" << theta);
        CHECK(quadrature_albedo(info, degrees(theta), degrees(25), values.data()) == Approx(total).epsilon(quadrature_400));
      }
  }
}

TEMPLATE_LIST_TEST_CASE("a closed albedo never exceeds its bound, and reaches it", "[models]", Models) {
  if constexpr (ClosedAlbedo<TestType>) {
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
  } else {
    SUCCEED("no closed form");
  }
}

TEST_CASE("a cosine lobe is nothing where its cosine is not positive, at s = 0 too", "[models]") {
  LobeGeometry g;
  g.log_cos_h = g.log_cos_psi = g.log_cos_retro = LobeGeometry::no_lobe;
  for (const ModelInfo& info : model_infos()) {
    // The back vector of the last has no logarithm of its own in the geometry.
    if (info.nonlinear_count() != 1 || info.parameters.back().name != "s" || info.name == "retro-blinn-phong") continue;
    std::vector<double> values = test::example_values(info);
    values.back() = 0;
    INFO(info.name);
    CHECK(info.evaluate(g, values.data()) == Approx(values.front() / pi));
  }
}

TEST_CASE("models have distinct names, citations and sound parameter tables") {
  std::set<std::string_view> names;
  for (const ModelInfo& info : model_infos()) {
    INFO(info.name);
    CHECK(names.insert(info.name).second);
    CHECK(info.citation.size() > 20);
    std::set<std::string_view> parameters;
    bool nonlinear_seen = false;
    for (const Parameter& p : info.parameters) {
      INFO(p.name);
      CHECK(parameters.insert(p.name).second);
      CHECK(p.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos);
      CHECK_FALSE(p.unit.empty());
      CHECK(p.lower < p.upper);
      CHECK(p.lower <= p.example);
      CHECK(p.example <= p.upper);
      if (!p.linear) {
        CHECK(p.lower <= p.scan_low);
        CHECK(p.scan_low < p.scan_high);
        CHECK(p.scan_high <= p.upper);
        CHECK((p.axis == Parameter::Axis::linear || p.scan_low > 0));
      }
      CHECK_FALSE((p.linear && nonlinear_seen));
      nonlinear_seen = nonlinear_seen || !p.linear;
    }
  }
  CHECK(names.size() == std::tuple_size_v<Models>);
}
