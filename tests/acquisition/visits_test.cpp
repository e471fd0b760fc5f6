// SPDX-License-Identifier: BSD-3-Clause
// Interpolation between visits and its uncertainty.
#include "acquisition/visits.hpp"

#include <cmath>

#include "tests/check.hpp"

using gonio::acquisition::Visits;

TEST_CASE("values between visits lie on the line, outside them on the nearest visit") {
  const Visits visits({{10, 4, 0}, {0, 2, 0}, {30, 0, 0}});  // in any order
  CHECK(visits.at(-5) == 2);
  CHECK(visits.at(0) == 2);
  CHECK(visits.at(5) == 3);
  CHECK(visits.at(10) == 4);
  CHECK(visits.at(20) == 2);
  CHECK(visits.at(99) == 0);
  CHECK(Visits({{7, 3, 0}}).at(1) == 3);
}

TEST_CASE("shared and local variance add up to that of the interpolated value") {
  const Visits visits({{0, 1, 4}, {10, 1, 4}, {20, 1, 4}, {30, 1, 4}});
  CHECK(visits.common_variance() == 1);  // 4 visits of variance 4
  CHECK(visits.local_variance(0) == 3);
  CHECK(visits.local_variance(5) == 1);  // the mean of two visits has 2
  CHECK(visits.local_variance(99) == 3);
}

TEST_CASE("a straight course has no drift left, a curved one a quarter of its bend") {
  CHECK(Visits({{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {4, 5, 0}}).straightness() == 0);
  // y = t²: the neighbours' line is off by 1 at every inner visit, the line between two visits by 1/4.
  CHECK(Visits({{0, 0, 0}, {1, 1, 0}, {2, 4, 0}, {3, 9, 0}}).straightness() == Approx(0.25));
  // The same bend is nothing that noise of that size does not explain.
  CHECK(Visits({{0, 0, 1}, {1, 1, 1}, {2, 4, 1}, {3, 9, 1}}).straightness() == 0);
}

TEST_CASE("two visits leave half their difference open, one visit everything") {
  CHECK(Visits({{0, 1, 0}, {1, 1.12, 0}}).straightness() == Approx(0.12 / std::sqrt(12.0)));
  CHECK(std::isnan(Visits({{0, 1, 0}}).straightness()));
}
