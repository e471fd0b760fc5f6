// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/neighbourhood.hpp"

#include <cmath>

#include "tabulated/guided_table.hpp"
#include "tests/tabulated/measured_model.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

double kriged(const GuidedSamples& samples, const Neighbourhood& near, const PairPoint& at) {
  KrigingWeights weights;
  near.weights_at(at, weights);
  double y = 0;
  for (std::size_t k = 0; k < near.places().size(); ++k) y += weights.weight[k] * samples.rest[0][near.places()[k]];
  return y;
}

}  // namespace

TEST_CASE("What boxes give is as near to the truth as what every place by itself gives") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  const AnalyticBrdf truth = test::model("blinn-phong", {0.2, 0.3, 50}), guide = test::model("blinn-phong", {0.2, 0.3, 60});
  const GuidedSamples samples = guided_samples(*test::measured(truth, test::planned({}), std::nullopt, random), &guide);
  const CorrelationRanges ranges{4, 4};
  const Neighbourhoods boxes(samples, ranges);
  double by_box = 0, by_itself = 0, difference = 0;
  std::size_t n = 0, differently = 0;
  for (const GonioAngles& angles : test::scattered(3000, random)) {
    const PairPoint at = samples.place(angles.wi(), angles.wo());
    const auto box = boxes.of(Neighbourhoods::box_of(at));
    if (box->crowded()) continue;
    const Neighbourhood alone = boxes.at(at);
    differently += alone.coverage(at, alone.nearest(at)) != box->coverage(at, box->nearest(at));
    if (alone.coverage(at, alone.nearest(at)) != Coverage::interpolated) continue;
    const double g = guide.eval(angles)[0], wanted = (truth.eval(angles)[0] - g) / (g + samples.floor[0]);
    const double one = kriged(samples, alone, at), all = kriged(samples, *box, at);
    ++n, by_box += (all - wanted) * (all - wanted), by_itself += (one - wanted) * (one - wanted), difference += (one - all) * (one - all);
  }
  INFO(n << " places: sums of squared errors " << by_box << " and " << by_itself << ", of the difference " << difference);
  CHECK(n > 2000);
  CHECK(by_box < 1.1 * by_itself);
  CHECK(static_cast<double>(differently) < 0.02 * static_cast<double>(n));
}

TEST_CASE("Samples of a box take part in it even where they hide behind each other; too many make it crowded") {
  test::Random random(test::seed);
  std::vector<GonioAngles> angles = test::planned({});
  const std::size_t planned = angles.size();
  // Rows far denser than the plan: two values each in a box, and dozens.
  for (int k = 0; k < 8; ++k) angles.push_back({30_deg, 0_deg, degrees(41 + 0.7 * k), 33_deg});
  for (int k = 0; k < 200; ++k) angles.push_back({50_deg, 0_deg, degrees(31 + 0.05 * k), 133_deg});
  const auto data = test::measured(test::model("lambert", {0.4}), angles, test::Noise{0.05, 0}, random);
  const GuidedSamples samples = guided_samples(*data, nullptr);
  const Neighbourhoods boxes(samples, CorrelationRanges{4, 4});
  std::size_t crowded = 0;
  for (std::size_t place = 0; place < samples.places->size(); ++place) {
    const PairPoint at = (*samples.places)[place];
    const auto box = boxes.of(Neighbourhoods::box_of(at));
    if (box->crowded()) {
      ++crowded;
      continue;
    }
    const auto nearest = box->nearest(at);
    REQUIRE(nearest.is_here);
    REQUIRE(box->places()[nearest.index] == place);
  }
  CHECK(crowded > 100);
  CHECK(crowded < 400);
  const GuidedTable table(data, nullptr);
  for (std::size_t k = planned; k < data->size(); ++k) CHECK(table.eval(data->angles[k].wi(), data->angles[k].wo())[0] == data->f[0][k]);
}

TEST_CASE("A place among the samples is interpolated, one beyond them extrapolated, by a box as by itself") {
  test::Random random(test::seed);
  const GuidedSamples samples =
      guided_samples(*test::measured(test::model("lambert", {0.4}), test::planned({}), std::nullopt, random), nullptr);
  const Neighbourhoods boxes(samples, CorrelationRanges{4, 4});
  const auto coverage = [&](const GonioAngles& angles, bool by_box) {
    const PairPoint at = samples.place(angles.wi(), angles.wo());
    const auto box = boxes.of(Neighbourhoods::box_of(at));
    const Neighbourhood alone = boxes.at(at);
    return by_box ? box->coverage(at, box->nearest(at)) : alone.coverage(at, alone.nearest(at));
  };
  for (const bool by_box : {false, true}) {
    CHECK(coverage({40_deg, 0_deg, 42_deg, 45_deg}, by_box) == Coverage::interpolated);
    CHECK(coverage({40_deg, 0_deg, 87_deg, 45_deg}, by_box) == Coverage::extrapolated);
    CHECK(coverage({85_deg, 0_deg, 42_deg, 45_deg}, by_box) == Coverage::extrapolated);
  }
}

TEST_CASE("Values depend neither on the order of asking nor on what else was asked") {
  test::Random random(test::seed);
  const auto data = test::measured(test::model("blinn-phong", {0.2, 0.3, 50}), test::scattered(400, random), test::Noise{}, random);
  const GuidedTable forwards(data, nullptr), backwards(data, nullptr);
  const std::vector<GonioAngles> where = test::scattered(1000, random);
  std::vector<double> first(where.size()), second(where.size());
  for (std::size_t k = 0; k < where.size(); ++k) first[k] = forwards.eval(where[k].wi(), where[k].wo())[0];
  for (std::size_t k = where.size(); k-- > 0;) second[k] = backwards.eval(where[k].wi(), where[k].wo())[0];
  CHECK(first == second);
}
