// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/contrasts.hpp"

#include <cmath>
#include <random>

#include "fitting/distributions.hpp"

#include "tests/check.hpp"

using namespace gonio::fitting;

namespace {

/// n pairs of readings of 1 with a noise of 1 % that differ by `skew` · x, x even in [-1, 1], the pattern tested.
Contrasts pairs(std::size_t n, double skew, double stated_u, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0, 0.01);
  Contrasts out;
  out.pattern_names = {"x"};
  out.pattern_share = {0.5};
  for (std::size_t k = 0; k < n; ++k) {
    const double x = 2 * (static_cast<double>(k) + .5) / static_cast<double>(n) - 1;
    for (const double side : {.5, -.5}) out.readings.push_back({1 + side * skew * x + noise(random), stated_u, {}, {}, 0});
    out.contrasts.push_back({{{2 * k, 1}, {2 * k + 1, -1}}, 1, 1, 0, {x}, k});
  }
  return out;
}

}  // namespace

TEST_CASE("χ², amplitude and excess come out as put in") {
  const ContrastTest null = test_contrasts(pairs(2000, 0, .01, 1), .02, .01);
  CHECK(null.chi2 / null.dof == Approx(1).margin(4 * std::sqrt(2 / 2000.)));
  CHECK(null.effective_dof == Approx(2000));
  CHECK(null.strongest == -1);
  const ContrastTest skewed = test_contrasts(pairs(2000, .03, .01, 1), .02, .01);
  REQUIRE(skewed.directed.size() == 1);
  CHECK(skewed.strongest == 0);
  CHECK(skewed.directed[0].amplitude == Approx(.03 / std::sqrt(3.)).margin(4 * skewed.directed[0].u));
  CHECK(skewed.directed[0].u == Approx(.01 * std::sqrt(2.) / std::sqrt(2000.)).epsilon(.01));
  CHECK(skewed.effect == Approx(.03 / std::sqrt(3.)).epsilon(.1));
}

TEST_CASE("A shared component that explains the pattern takes it away, and an unseen pattern is no test") {
  Contrasts set = pairs(500, .03, .01, 2);
  for (std::size_t k = 0; k < set.contrasts.size(); ++k)
    for (const double side : {.5, -.5}) set.readings[2 * k + (side < 0)].shared = {side * set.contrasts[k].pattern[0]};
  const ContrastTest test = test_contrasts(set, .02, .01);
  CHECK(test.p_value > .001);
  CHECK(test.amplitude.at(0) == Approx(.03).epsilon(.1));
  Contrasts flat = pairs(500, 0, .01, 2);
  for (Contrast& contrast : flat.contrasts) contrast.pattern = {0};
  CHECK(test_contrasts(flat, .02, .01).directed.empty());
}

TEST_CASE("Contrasts that share a reading have fewer effective degrees of freedom") {
  Contrasts set = pairs(100, 0, .01, 3);
  for (Contrast& contrast : set.contrasts) contrast.terms[1].reading = 1;  // all against one reading: correlated by 1/2
  const ContrastTest test = test_contrasts(set, .02, .01);
  CHECK(test.effective_dof == Approx(100 * 100 / (100 + 100 * 99 * .25)));
}

TEST_CASE("Noise that is understated is told from a pattern and from outliers") {
  const auto factor = [](const Contrasts& set) { return understated_noise(set, test_contrasts(set, .02, .01), .01); };
  CHECK(factor(pairs(1000, 0, .005, 4)) == Approx(2).epsilon(.1));
  CHECK(factor(pairs(1000, .06, .005, 4)) == 1);
  CHECK(factor(pairs(1000, 0, .002, 4)) == 1);  // by five: nobody does
  Contrasts outliers = pairs(1000, 0, .01, 5);
  for (std::size_t k = 0; k < 1000; k += 50) outliers.readings[k].f += .2;
  CHECK(factor(outliers) == 1);
}

TEST_CASE("Places are tested together where they share a place, and unknown uncertainties are left out") {
  Contrasts set = pairs(10, 0, .01, 6);
  for (Contrast& contrast : set.contrasts) contrast.place /= 2;
  set.readings[0].u = std::nan("");
  const ContrastTest test = test_contrasts(set, .02, .01);
  CHECK(test.n == 9);
  CHECK(!std::isfinite(test.z[0]));
  const PlaceTests places = place_tests(set, test, {"Y"});
  REQUIRE(places.p.size() == 5);
  CHECK(places.p[0] == Approx(chi2_upper_tail(test.z[1] * test.z[1], 1)));
  CHECK(places.p[1] == Approx(chi2_upper_tail(test.z[2] * test.z[2] + test.z[3] * test.z[3], 2)));
  for (Reading& reading : set.readings) reading.u = std::nan("");
  CHECK(!test_contrasts(set, .02, .01).has_uncertainty);
}
