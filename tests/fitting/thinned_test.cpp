// SPDX-License-Identifier: BSD-3-Clause
// A part of many rows costs what all of them cost, to a few per cent, and keeps their peak.
#include "fitting/thinned.hpp"

#include "fitting/profile.hpp"
#include "tests/fitting/ngan_grid.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("a thinned cost has its minimum where that of all rows has it") {
  const auto data = NoisyReadings(ngan_material(2000), gantry_grid()).draw(5);
  const Terms all = make_terms(*observe(data), model_kernel("blinn-phong-ngan"), Metric::linear, 1);
  const Terms part = thinned(all, 2048);
  CHECK(part.rows() <= 2048);
  CHECK(part.rows() > 1000);
  const std::vector<LinearLimits> free(3, LinearLimits{std::vector<double>(2, std::nan("")), {}, {}});
  for (const double s : {20.0, 500.0, 8000.0})
    CHECK(Profile(part, free).at(std::vector{s}).cost == Approx(Profile(all, free).at(std::vector{s}).cost).epsilon(0.15));
  const double here = Profile(part, free).at(std::vector{2000.0}).cost;
  for (const double s : {1600.0, 2500.0}) CHECK(Profile(part, free).at(std::vector{s}).cost > 2 * here);
  for (std::size_t c = 0; c < 3; ++c) {
    double whole = 0, kept = 0;
    for (const double w : all.channel[c].weight) whole += w;
    for (const double w : part.channel[c].weight) kept += w;
    CHECK(kept == Approx(whole).epsilon(1e-12));
  }
}

TEST_CASE("few rows are left as they are") {
  const auto data = NoisyReadings(ngan_material(50), gantry_grid()).draw(5);
  const Terms all = make_terms(*observe(data), model_kernel("blinn-phong-ngan"), Metric::linear, 1);
  CHECK(thinned(all, all.rows()).rows() == all.rows());
}
