// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/numeric_albedo.hpp"

#include <cmath>

#include "tests/brdf/model_parameters.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

double lobe_albedo(const ModelInfo& model, Angle theta_i, const std::vector<double>& nonlinear, bool numeric) {
  std::vector<double> out(model.linear_count);
  if (numeric)
    numeric_albedo(model, theta_i, 25_deg, nonlinear.data(), out.data());
  else
    model.albedo(theta_i, 25_deg, nonlinear.data(), out.data());
  return out.back();
}

}  // namespace

TEST_CASE("the numerical albedo agrees with the closed forms, for lobes of any width up to grazing") {
  for (const char* name : {"lambert", "phong", "blinn-phong"})
    for (const double s : {1.0, 10.0, 1e3, 1e5, 1e7})
      for (const double theta : {0.0, 30.0, 60.0, 80.0, 85.0, 89.0}) {
        INFO(name << " s=" << s << " theta=" << theta);
        // The kink of the Phong lobe at 90° from its axis is visible at s = 1 only.
        const double tolerance = s == 1 && std::string_view(name) == "phong" ? 5e-3 : 2e-4;
        const ModelInfo& model = model_info(name);
        CHECK(lobe_albedo(model, degrees(theta), {s}, true) == Approx(lobe_albedo(model, degrees(theta), {s}, false)).epsilon(tolerance));
      }
}

TEST_CASE("the numerical albedo agrees with the closed forms of a lifted lobe and of a rough diffuse surface") {
  constexpr double quadrature = 1e-3;  // kinks: the horizon of the lobe, the plane across the incidence
  for (const double theta : {0.0, 30.0, 60.0, 85.0, 89.0})
    for (const double delta : {40.0, 45.0, 60.0}) {
      INFO("theta=" << theta << " delta=" << delta);
      const ModelInfo& model = model_info("lafortune");
      CHECK(lobe_albedo(model, degrees(theta), {20, delta}, true) ==
            Approx(lobe_albedo(model, degrees(theta), {20, delta}, false)).epsilon(quadrature));
    }
  // Nearer to grazing the ridge towards the light is too narrow for nodes that crowd about the mirror direction.
  for (const double theta : {0.0, 30.0, 60.0})
    for (const double sigma : {0.0, 20.0, 60.0}) {
      INFO("theta=" << theta << " sigma=" << sigma);
      const ModelInfo& model = model_info("oren-nayar");
      CHECK(lobe_albedo(model, degrees(theta), {sigma}, true) ==
            Approx(lobe_albedo(model, degrees(theta), {sigma}, false)).epsilon(quadrature));
    }
}

TEST_CASE("the numerical albedo turns with an anisotropic sample") {
  const ModelInfo& model = model_info("ward-duer-gm-anisotropic");
  const double wide[2] = {0.1, 0.3}, turned[2] = {0.3, 0.1};
  for (const double theta : {20.0, 70.0}) {
    double a[2], b[2];
    numeric_albedo(model, degrees(theta), 25_deg, wide, a);
    numeric_albedo(model, degrees(theta), 115_deg, turned, b);
    CHECK(a[1] == Approx(b[1]).epsilon(1e-4));
  }
}

TEST_CASE("a surface of facets never reflects more than it receives, and Ward's first lobe does") {
  // Lobes with F0 = F90 = 1, or ρs = 1.
  constexpr double quadrature = 1e-3;
  for (const char* name : {"ggx", "ggx-separable", "cook-torrance", "ward-duer-gm", "ashikhmin-shirley"}) {
    const ModelInfo& model = model_info(name);
    double largest = 0;
    for (const std::vector<double>& values : test::parameter_settings(model, 3))
      for (const double theta : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0}) {
        std::vector<double> each(model.linear_count);
        numeric_albedo(model, degrees(theta), 25_deg, values.data() + model.linear_count, each.data());
        double sum = 0;
        for (std::size_t k = 1; k < each.size(); ++k) sum += each[k];
        largest = std::max(largest, sum);
      }
    INFO(name << ' ' << largest);
    CHECK(largest <= 1 + quadrature);
    CHECK(largest > 0.9);
  }
  const ModelInfo& anisotropic = model_info("ward-duer-gm-anisotropic");
  for (const double theta : {0.0, 60.0, 85.0}) CHECK(lobe_albedo(anisotropic, degrees(theta), {0.05, 0.5}, true) <= 1 + quadrature);
  const ModelInfo& ward = model_info("ward");
  CHECK_FALSE(ward.properties.bounded);
  CHECK(lobe_albedo(ward, 89.9999_deg, {0.5}, true) > 3 * lobe_albedo(ward, 89.9_deg, {0.5}, true));
}
