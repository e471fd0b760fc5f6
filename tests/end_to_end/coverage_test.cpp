// SPDX-License-Identifier: BSD-3-Clause
// Are the error bars honest? The demo's sweep with 300 seeds of noise, reduced and fitted.
#include <cmath>
#include <map>
#include <string>

#include "fitting/fit.hpp"
#include "tests/simulated_sweep.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("over 300 seeds the 95 % intervals of every parameter hold the truth in 91 to 98.5 %") {
  constexpr int seeds = 300;
  constexpr double normal_quantile = 1.959964;
  std::map<std::string, int> held, half_held;
  int two_sided = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const test::TemporaryFolder folder;
    const acquisition::Bench bench = test::example_bench("demo.bench.json", static_cast<std::uint64_t>(seed));
    const auto sample = test::example_sample(bench);
    const auto data = std::make_shared<Dataset>(test::measure(bench, test::example_plan("demo.plan.json"), sample, folder / "run.gonio"));
    fitting::FitOptions options;
    options.model = std::string(sample->model().name);
    const fitting::FitResult fit = fitting::fit(*observe(data), options);
    REQUIRE(fit.status == fitting::Status::converged);
    for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
      const auto& p = fit.parameters[k];
      two_sided += p.kind == fitting::IntervalKind::interval;
      const double truth = sample->values()[0][k];
      // The certificate's error and the other common factors stand beside the intervals of the linear parameters.
      const double extra = p.channel ? normal_quantile * fit.u_scale.value_or(0) * p.value : 0;
      const double below = std::hypot(p.value - p.low.value_or(p.value), extra),
                   above = std::hypot(p.high.value_or(p.value) - p.value, extra);
      held[p.name] += p.low && p.high && p.value - below <= truth && truth <= p.value + above;
      // The gate must be able to fail: intervals of half the width.
      half_held[p.name] += p.value - below / 2 <= truth && truth <= p.value + above / 2;
    }
  }
  CHECK(two_sided == 3 * seeds);
  REQUIRE(held.size() == 3);
  // A perfect 95 % interval misses these bounds with probability below 1 % (binomial, 300 draws).
  for (const auto& [name, count] : held) {
    const double fraction = static_cast<double>(count) / seeds;
    WARN(name << ": held in " << 100 * fraction << " % of " << seeds << " seeds");
    CHECK(fraction >= 0.91);
    CHECK(fraction <= 0.985);
    CHECK(half_held[name] < 0.91 * seeds);
  }
}
