// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/check.hpp"

#include <cmath>

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

TEST_CASE("judge: significant and large fails, significant warns, equivalent passes, anything else cannot tell") {
  CHECK(judge(true, .05, .06, .02) == Verdict::fail);
  CHECK(judge(true, .01, .015, .02) == Verdict::warn);
  CHECK(judge(false, .005, .015, .02) == Verdict::pass);
  CHECK(judge(false, .005, .03, .02) == Verdict::vacuous);
}

TEST_CASE("Relative numbers are told with two digits, whole above 100 %, and not below rounding") {
  CHECK(percent_text(.00951) == "0.95 %");
  CHECK(percent_text(0) == "0 %");
  CHECK(percent_text(1.104) == "110 %");
  CHECK(percent_text(-.05) == "-5 %");
  CHECK(percent_text(3e-14) == "less than 1e-6 %");
  CHECK(percent_text(std::nan("")) == "unknown");
}
