// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/stretch_search.hpp"

#include <cmath>
#include <span>

#include "fitting/global_search.hpp"
#include "fitting/thinned.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

const std::vector<LinearLimits> free_limits{1, {std::vector<double>(2, NAN), {}, {}}};

/// 7905 readings of a lobe, and what the search on a part of them finds.
struct Problem {
  explicit Problem(const test::Noise& noise)
      : kernel(model_kernel("blinn-phong")),
        terms(make_terms(
            *observe(test::readings(test::lobe("blinn-phong", 0.2, 0.3, 300), test::polar_grid({0, 20, 40, 60, 75}, 2, 9), noise, 7)),
            kernel, Metric::linear, 1)),
        space(kernel, {{NAN, NAN, NAN}}, {true}) {
    const Terms few = thinned(terms, 1000);
    looked_at = few.rows();
    Profile of_few(few, free_limits);
    about = search_globally(of_few, space, 1).minima.front();
  }
  ModelKernel kernel;
  Terms terms;
  SearchSpace space;
  std::size_t looked_at = 0;
  Minimum about;
};

}  // namespace

TEST_CASE("a stretch holds the minimum of all rows, and what is interpolated there is what the rows say") {
  const Problem problem({1e-4, 0, 0.01});
  Profile profile(problem.terms, free_limits);
  const auto found = search_on_stretch(profile, problem.space, problem.about, problem.looked_at, 2);
  REQUIRE(found);
  const Profile rows(problem.terms, free_limits);
  const Minimum by_descent = descend(rows, problem.space, problem.about.z);
  const double variance = by_descent.point.cost / static_cast<double>(problem.terms.rows());
  CHECK(found->lowest.point.cost - by_descent.point.cost <= 1e-4 * variance);
  REQUIRE(found->scan.size() > 2);
  for (const ProfilePoint& point : found->scan) {
    const ProfilePoint wanted = rows.at(point.theta);
    INFO("s " << point.theta.front());
    CHECK(std::fabs(point.cost - wanted.cost) <= 1e-4 * variance);
    CHECK(point.channel[0].x[1] == Approx(wanted.channel[0].x[1]).epsilon(1e-9));
  }
  CHECK(found->scan.front().cost > found->well_above);
  CHECK(found->scan.back().cost > found->well_above);

  Profile alone(problem.terms, free_limits);
  const auto again = search_on_stretch(alone, problem.space, problem.about, problem.looked_at, 1);
  REQUIRE(again);
  CHECK(again->lowest.z == found->lowest.z);
}

TEST_CASE("without noise there is nothing to interpolate: the stretch is given up and the profile looks at the rows again") {
  const Problem problem({});
  Profile profile(problem.terms, free_limits);
  CHECK_FALSE(search_on_stretch(profile, problem.space, problem.about, problem.looked_at, 1));
  const Profile rows(problem.terms, free_limits);
  for (const double s : {299.0, 300.0, 301.0}) CHECK(profile.at(std::span(&s, 1)).cost == rows.at(std::span(&s, 1)).cost);
}
