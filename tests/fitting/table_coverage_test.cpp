// SPDX-License-Identifier: BSD-3-Clause
// The figures for tables: weights from the scatter inside rows that are collapsed give intervals that hold what they say.
#include "tests/fitting/interval_coverage.hpp"
#include "tests/fitting/ngan_grid.hpp"
#include "tests/fitting/theta_h_table.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::test;

TEST_CASE("95 % intervals of a table's collapsed fit hold all seven parameters in 93 to 97 % of 1000 draws") {
  // Standard error 0.7 %: a true 95 % leaves 93 to 97 % in 0.3 % of sets of seeds, for one parameter.
  constexpr int draws = 1000;
  constexpr std::size_t cells = 180;  // a row, of MERL's 16 200: the collapse and the weights are the same
  unsigned first = 1;
  for (const double s : {50.0, 2000.0, 20000.0}) {
    const AnalyticBrdf truth = ngan_material(s);
    const Coverage found =
        coverage(truth, first, draws, [&](unsigned seed) { return std::make_shared<ThetaHTable>(noisy_table(truth, cells, seed)); });
    WARN("table, s " << s << ", seeds from " << first << found.text());
    INFO("s " << s);
    require_coverage(found, 7, 93, 97);
    first += draws;
  }
}
