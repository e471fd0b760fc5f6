// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/distributions.hpp"

#include <cmath>

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

TEST_CASE("distributions agree with tabulated values") {
  CHECK(normal_upper_tail(1.959963984540054) == Approx(0.025).epsilon(1e-12));
  CHECK(normal_upper_quantile(0.025) == Approx(1.959963984540054).epsilon(1e-12));
  CHECK(normal_upper_tail(10) == Approx(7.61985302416e-24).epsilon(1e-10));
  CHECK(chi2_upper_tail(3.841458820694124, 1) == Approx(0.05).epsilon(1e-11));
  CHECK(chi2_upper_tail(124.34211340400407, 100) == Approx(0.05).epsilon(1e-10));
  CHECK(chi2_upper_tail(0, 5) == 1);
  CHECK(student_two_sided_quantile(0.95, 1) == Approx(12.706204736174694).epsilon(1e-9));
  CHECK(student_two_sided_quantile(0.95, 10) == Approx(2.2281388519649385).epsilon(1e-9));
  CHECK(student_two_sided_quantile(0.95, 1e6) == Approx(1.95996635682).epsilon(1e-7));
  CHECK(binomial_upper_tail(3, 10, 0.1) == Approx(0.0701908264).epsilon(1e-8));
  CHECK(binomial_upper_tail(1, 10, 0.5) == Approx(1 - std::pow(.5, 10)).epsilon(1e-12));
  CHECK(binomial_upper_limit(0, 100, 0.01) == Approx(1 - std::pow(.01, .01)).epsilon(1e-9));
}
