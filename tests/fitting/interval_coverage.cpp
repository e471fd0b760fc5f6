// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fitting/interval_coverage.hpp"

#include "tests/check.hpp"

namespace gonio::test {

void require_coverage(const Coverage& found, std::size_t parameters, double fewest, double most) {
  CHECK(found.converged == found.draws);
  REQUIRE(found.parameters.size() == parameters);
  for (const ParameterCoverage& p : found.parameters) {
    INFO(p.name);
    CHECK(found.percent(p) >= fewest);
    CHECK(found.percent(p) <= most);
    // The gate itself: intervals of half the width do not get through.
    CHECK(found.half_percent(p) < fewest);
  }
}

}  // namespace gonio::test
