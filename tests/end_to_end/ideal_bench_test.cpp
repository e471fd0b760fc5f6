// SPDX-License-Identifier: BSD-3-Clause
// The ideal bench closes the chain: what went in as a model comes out as samples, over real sockets.
#include <cmath>

#include "tests/simulated_sweep.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

/// The ideal bench with axes whose zero lies between two counts, so that no asked pose (plans are in whole microdegrees) is a count.
acquisition::Bench bench_between_counts() {
  Json bench = parse_json(example_text("ideal.bench.json"), "bench"), axes = Json::array();
  for (const Json& axis : bench.at("axes").elements()) {
    Json shifted = axis;
    shifted.set("zero_offset_deg", 3.7e-7);
    axes.push_back(shifted);
  }
  bench.set("axes", axes);
  return acquisition::bench_from(bench, ".");
}

}  // namespace

TEST_CASE("an ideal bench gives the model at the read-back pose to 1e-12, and the asked pose within half a count") {
  const test::TemporaryFolder folder;
  const acquisition::Bench bench = bench_between_counts();
  const auto sample = test::example_sample(bench);
  const Dataset data = test::measure(bench, test::example_plan("demo.plan.json"), sample, folder / "run.gonio");
  REQUIRE(data.size() > 500);
  REQUIRE(bench.axes.front().counts_per_deg == 1e6);
  // The meter prints 17 digits and the equation has a dozen operations: 1e-12 leaves room for nothing but rounding.
  constexpr double rounding_only = 1e-12;
  constexpr double half_count_deg = 0.5e-6 * (1 + 1e-6);  // 1 count = 1 µdeg
  double worst = 0, worst_angle = 0;
  for (std::size_t k = 0; k < data.size(); ++k) {
    worst = std::fmax(worst, std::fabs(data.f[0][k] / sample->eval(data.angles[k])[0] - 1));
    worst_angle = std::fmax(worst_angle, std::fabs(data.angles[k].theta_i.degrees() - data.extra.at("commanded_theta_i_deg")[k]));
    worst_angle = std::fmax(worst_angle, std::fabs(data.angles[k].theta_o.degrees() - data.extra.at("commanded_theta_o_deg")[k]));
  }
  WARN("worst relative error " << worst << ", worst zenith angle " << worst_angle << "° from the asked one, over " << data.size()
                               << " samples");
  CHECK(worst < rounding_only);
  CHECK(worst_angle <= half_count_deg);
  CHECK(worst_angle > half_count_deg / 100);  // the poses do lie between counts
}

TEST_CASE("the closure sees a model that is wrong by 1e-9") {
  const test::TemporaryFolder folder;
  const acquisition::Bench bench = bench_between_counts();
  const auto sample = test::example_sample(bench);
  const Dataset data = test::measure(bench, test::example_plan("demo.plan.json"), sample, folder / "run.gonio");
  auto values = sample->values();
  values[0][0] *= 1 + 1e-9;
  const AnalyticBrdf wrong(sample->model().name, single_channel("value"), values);
  double worst = 0;
  for (std::size_t k = 0; k < data.size(); ++k) worst = std::fmax(worst, std::fabs(data.f[0][k] / wrong.eval(data.angles[k])[0] - 1));
  CHECK(worst > 1e-12);
}
