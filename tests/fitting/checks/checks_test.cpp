// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include <cmath>
#include <string>

#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("the list holds the checks by id") {
  std::vector<std::string> ids;
  for (const CheckEntry& entry : check_list()) {
    ids.emplace_back(entry.id);
    CHECK(entry.run({}, {}).id == entry.id);
    CHECK(entry.run({}, {}).verdict == Verdict::vacuous);
  }
  CHECK(ids == std::vector<std::string>{"reciprocity", "isotropy", "bilateral", "energy", "positivity"});
}

TEST_CASE("Holm: a p-value that is small alone need not be small among all checks") {
  CheckSubject subject{{sweep(pairs_of_directions(), percent, 5)}, nullptr, nullptr};
  int alone = 0, together = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    subject.datasets = {sweep(pairs_of_directions(), percent, seed)};
    alone += *check_reciprocity(subject, {}).p_value < 0.01;
    for (const Check& check : run_checks(subject, {}))
      if (check.id == "reciprocity") together += check.verdict == Verdict::fail || check.verdict == Verdict::warn;
    if (seed == 60 && alone == 0) break;
  }
  CHECK(together <= alone);
}
