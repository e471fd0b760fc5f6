// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// f of a lobe with a bump of `size` about theta_o = 60° on the mirror side.
std::shared_ptr<Dataset> bumpy(double size, double s, unsigned seed) {
  const AnalyticBrdf truth = lobe("blinn-phong", .3, .2, s);
  auto data = readings(truth, polar_grid({10, 30}, 5, 30), percent, seed);
  for (std::size_t k = 0; k < data->size(); ++k) {
    const GonioAngles& a = data->angles[k];
    if (std::abs(a.phi_o.degrees() - 180) < 1) data->f[0][k] *= 1 + size * std::exp(-std::pow((a.theta_o.degrees() - 60) / 8, 2));
  }
  return data;
}

}  // namespace

TEST_CASE("monotonicity: a falling lobe and a flat surface pass and are seldom refused, a bump warns with its place") {
  const Check fair = run(check_monotonicity, bumpy(0, 20, 1)), bump = run(check_monotonicity, bumpy(.3, 200, 1));
  INFO(fair.detail << " / " << bump.detail);
  CHECK(fair.verdict == Verdict::pass);
  CHECK(bump.verdict == Verdict::warn);
  CHECK(bump.detail.find("beyond the mirror direction") != std::string::npos);
  int refused_lobe = 0, refused_flat = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    refused_lobe += *run(check_monotonicity, bumpy(0, 20, seed)).p_value < .01;
    const AnalyticBrdf flat("lambert", single_channel("Y"), {{.5}});
    refused_flat += *run(check_monotonicity, readings(flat, polar_grid({10, 30}, 5, 30), percent, seed)).p_value < .01;
  }
  // Of 100 right ones more than 6 are refused at 1 % with a probability below 0.01 %.
  CHECK(refused_lobe <= 6);
  CHECK(refused_flat <= 6);
}

TEST_CASE("monotonicity: without u the size alone, models exactly, and no in-plane scan is vacuous") {
  auto bare = bumpy(.5, 1, 1);
  bare->u.clear();
  const Check unknown = run(check_monotonicity, bare);
  INFO(unknown.detail);
  CHECK(unknown.verdict == Verdict::vacuous);
  CHECK(*unknown.effect > .02);
  CHECK(!unknown.p_value);
  CHECK(check_monotonicity({{}, nullptr, std::make_shared<AnalyticBrdf>(lobe("blinn-phong", .3, .2, 20))}, {}).verdict == Verdict::pass);
  CHECK(run(check_monotonicity, sweep({{degrees(20), degrees(0), degrees(30), degrees(90)}}, percent, 1)).verdict == Verdict::vacuous);
}
