// SPDX-License-Identifier: BSD-3-Clause
// The figure: a directed test of 5 ± 1.5 % size and at least 80 % power at 0.1 % asymmetry, 3780 pairs, 1 % noise.
#include "tests/fitting/checks/refusals.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::test;

TEST_CASE("The directed reciprocity test has a size of 5 ± 1.5 % and a power of 80 % at an asymmetry of 0.1 %") {
  constexpr unsigned draws = 2000;
  const Refusals null = refusals(0, 1, draws), skewed = refusals(.001, 50001, draws);
  WARN("size " << null.combined << " combined, " << null.directed << " directed; power " << skewed.combined << ", " << skewed.directed);
  CHECK(std::abs(null.directed - .05) <= .015);
  CHECK(std::abs(null.combined - .05) <= .015);
  CHECK(skewed.directed >= .8);
  CHECK(skewed.combined >= .8);
}
