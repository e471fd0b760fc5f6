// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/albedo_quadrature.hpp"

#include <cmath>
#include <numbers>

#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

std::vector<AlbedoNode> nodes_of(const AnalyticBrdf& truth, const AnalyticBrdf* model, double theta_i_deg, double last_deg) {
  std::vector<AlbedoNode> nodes;
  for (const GonioAngles& a : polar_grid({theta_i_deg}, 5, 10)) {
    if (a.theta_o.degrees() > last_deg) continue;
    const double f = truth.eval(a)[0];
    nodes.push_back({a.wo(), f, .01 * f, {.02 * f}, model ? model->eval(a)[0] : 1});
  }
  return nodes;
}

AlbedoModel shape_of(const AnalyticBrdf& model, double theta_i_deg) {
  return {[&model, theta_i_deg](const Direction& wo) { return model.eval(Direction::spherical(degrees(theta_i_deg), degrees(0)), wo)[0]; },
          model.directional_albedo(degrees(theta_i_deg))[0]};
}

}  // namespace

TEST_CASE("The ratio to a model gives the albedo of a sharp lobe far better than the samples alone") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .4, 300), model = lobe("blinn-phong", .21, .37, 310);
  for (const double theta : {10., 40.}) {
    const double exact = truth.directional_albedo(degrees(theta))[0];
    const AlbedoModel shape = shape_of(model, theta);
    const AlbedoEstimate plain = scattered_albedo(nodes_of(truth, nullptr, theta, 80));
    const AlbedoEstimate ratio = scattered_albedo(nodes_of(truth, &model, theta, 80), &shape);
    INFO(theta << ": exact " << exact << ", plain " << plain.albedo << " ± " << plain.u() << ", ratio " << ratio.albedo << " ± "
               << ratio.u());
    CHECK(std::abs(ratio.albedo - exact) < 2 * ratio.u() + ratio.missing_bound);
    CHECK(std::abs(ratio.albedo + ratio.missing_bound - exact) < .01);
    CHECK(ratio.u_quadrature < plain.u_quadrature / 2);
    CHECK(ratio.u_scale == Approx(.02 * ratio.albedo));
  }
}

TEST_CASE("What no sample covers is bounded, and the whole lies between the bounds") {
  const AnalyticBrdf truth("lambert", single_channel("Y"), {{.7}});
  const AlbedoEstimate part = scattered_albedo(nodes_of(truth, nullptr, 20, 50));
  CHECK(part.covered < .85);
  CHECK(part.albedo < .7);
  CHECK(part.albedo + part.missing_bound == Approx(.7).epsilon(.005));
}

TEST_CASE("A function is integrated, and what it does not know is bounded") {
  const AnalyticBrdf truth = lobe("blinn-phong", .2, .4, 100);
  const auto estimates = evaluated_albedo(truth, Direction::spherical(degrees(30), degrees(0)));
  REQUIRE(estimates.size() == 1);
  CHECK(estimates[0].albedo == Approx(truth.directional_albedo(degrees(30))[0]).epsilon(1e-3));
  CHECK(estimates[0].covered == 1);
  CHECK(estimates[0].missing_bound == 0);
}
