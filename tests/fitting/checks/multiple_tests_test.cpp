// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/multiple_tests.hpp"

#include <algorithm>
#include <random>

#include "tests/check.hpp"

using namespace gonio::fitting;

namespace {

constexpr double rounding = 1e-12;

void check_equal(const std::vector<double>& found, const std::vector<double>& wanted) {
  REQUIRE(found.size() == wanted.size());
  for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k] == Approx(wanted[k]).epsilon(rounding));
}

}  // namespace

TEST_CASE("Holm and Benjamini-Hochberg adjust a worked example, in the order given") {
  // By hand: sorted .005, .01, .03, .04 times 4, 3, 2, 1, never falling; and times 4/1, 4/2, 4/3, 4/4, never rising from the end.
  check_equal(holm({.01, .04, .03, .005}), {.03, .06, .06, .02});
  check_equal(benjamini_hochberg({.01, .04, .03, .005}), {.02, .04, .04, .02});
  check_equal(holm({.9, .8}), {1, 1});
  CHECK(holm({}).empty());
  CHECK(benjamini_hochberg({}).empty());
}

TEST_CASE("Holm keeps the family-wise error, and Benjamini-Hochberg the false discovery rate below it in power") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  constexpr int draws = 2000;
  int any_false = 0;
  double false_part = 0;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<double> p;
    for (int k = 0; k < 20; ++k) p.push_back(k < 10 ? uniform(random) : uniform(random) * 1e-3);  // ten true, ten false hypotheses
    const auto family = holm(p), discovery = benjamini_hochberg(p);
    int false_ones = 0, all = 0;
    bool wrong = false;
    for (std::size_t k = 0; k < p.size(); ++k) {
      CHECK(discovery[k] <= family[k]);
      wrong = wrong || (k < 10 && family[k] < .05);
      if (discovery[k] < .05) ++all, false_ones += k < 10;
    }
    any_false += wrong;
    if (all > 0) false_part += static_cast<double>(false_ones) / all / draws;
  }
  // Three standard deviations of a proportion of 5 % in 2000 draws.
  CHECK(any_false <= .065 * draws);
  CHECK(false_part <= .065);
}

TEST_CASE("Places are told the least likely first, counted before the cut") {
  std::vector<Place> places(5);
  for (std::size_t k = 0; k < places.size(); ++k) places[k].channel = std::to_string(k), places[k].z = static_cast<double>(k);
  const Located found = locate(places, {1e-6, .5, 1e-9, 1e-3, .9}, .01, 2);
  CHECK(found.rejected_bh == 3);
  CHECK(found.rejected_holm == 3);
  REQUIRE(found.places.size() == 2);
  CHECK(found.places[0].channel == "2");
  CHECK(found.places[1].channel == "0");
  CHECK(*found.places[0].p_holm == Approx(5e-9));
}
