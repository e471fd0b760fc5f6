// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/checks.hpp"

#include <cmath>

#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

TEST_CASE("positivity: noise about zero passes, negative values fail, a single impossible one warns") {
  auto black = [](unsigned seed) {
    return readings(AnalyticBrdf("lambert", single_channel("Y"), {{0.0}}), pairs_of_directions(), {1e-3, 0, 0}, seed);
  };
  const Check noise = run(check_positivity, black(3));
  INFO(noise.detail);
  CHECK(noise.verdict == Verdict::pass);
  int refused_noise = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) refused_noise += *run(check_positivity, black(seed)).p_value < 0.01;
  CHECK(refused_noise <= most_refused);
  auto shifted = black(3);
  for (std::size_t k = 0; k < shifted->f[0].size(); k += 10) shifted->f[0][k] -= 0.02;
  CHECK(run(check_positivity, shifted).verdict == Verdict::fail);
  auto single = black(3);
  single->f[0][17] = -0.05;
  CHECK(run(check_positivity, single).verdict == Verdict::warn);
}
TEST_CASE("positivity: negatives of unknown uncertainty are counted but not judged") {
  auto data = sweep(pairs_of_directions(), percent, 1);
  data->u.clear();
  CHECK(run(check_positivity, data).verdict == Verdict::pass);
  data->f[0][3] = -1;
  const Check check = run(check_positivity, data);
  CHECK(check.verdict == Verdict::vacuous);
  CHECK(*check.effect == Approx(1.0 / static_cast<double>(data->size())));
}
