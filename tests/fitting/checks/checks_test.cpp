// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include <algorithm>
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
    const Verdict verdict = entry.run({}, {}).verdict;
    CHECK((verdict == Verdict::vacuous || verdict == Verdict::skipped));
  }
  CHECK(ids ==
        std::vector<std::string>{"reciprocity", "isotropy", "bilateral", "energy", "positivity", "monotonicity", "mirror_constancy"});
}

TEST_CASE("Holm: a check that warns alone need not warn among all the checks made") {
  // The asymmetry at which reciprocity alone has p = 0.005: below 1 %, above 1 % over the number of checks that are tests.
  const auto subject = [](double asymmetry) {
    return CheckSubject{{sweep(pairs_of_directions(), percent, 5,
                               [=](const GonioAngles& a) { return 1 + asymmetry * (a.theta_i.cos() - a.theta_o.cos()); })},
                        nullptr,
                        nullptr};
  };
  double low = 0, high = .05;
  for (int step = 0; step < 40; ++step) {
    const double middle = (low + high) / 2;
    (*check_reciprocity(subject(middle), {}).p_value > .005 ? low : high) = middle;
  }
  CHECK(check_reciprocity(subject(high), {}).verdict == Verdict::warn);
  const auto together = run_checks(subject(high), {});
  CHECK(together[0].verdict == Verdict::pass);
  CHECK(together[0].detail.find("not significant among all the checks") != std::string::npos);
  CHECK(std::count_if(together.begin(), together.end(), [](const Check& check) { return check.p_value.has_value(); }) > 2);
  CHECK(run_checks(subject(.1), {})[0].verdict == Verdict::fail);
}
