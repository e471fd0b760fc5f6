// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/check.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

TEST_CASE("judge: significant and large fails, significant warns, equivalent passes, anything else cannot tell") {
  CHECK(judge(true, .05, .06, .02) == Verdict::fail);
  CHECK(judge(true, .01, .015, .02) == Verdict::warn);
  CHECK(judge(false, .005, .015, .02) == Verdict::pass);
  CHECK(judge(false, .005, .03, .02) == Verdict::vacuous);
}
