// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/guided_samples.hpp"

#include <cmath>
#include <limits>

#include "brdf/error.hpp"
#include "tests/tabulated/measured_model.hpp"
#include "tests/tabulated/one_channel.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("Repeats become their weighted mean with the larger of the stated and the observed uncertainty") {
  const GonioAngles a{30_deg, 0_deg, 30_deg, 180_deg}, b{30_deg, 0_deg, 50_deg, 180_deg};
  const GuidedSamples agreeing = guided_samples(test::one_channel({a, a, b}, {1.0, 1.1, 5}, {0.1, 0.2, 1}), nullptr);
  REQUIRE(agreeing.means.size() == 2);
  CHECK(agreeing.means.f[0][0] == Approx((1.0 / 0.01 + 1.1 / 0.04) / 125));
  CHECK(agreeing.means.u[0][0] == Approx(1 / std::sqrt(125.0)));
  const GuidedSamples disagreeing = guided_samples(test::one_channel({a, a, b}, {1.0, 3.0, 5}, {0.1, 0.1, 1}), nullptr);
  CHECK(disagreeing.means.u[0][0] == Approx(1));  // half the difference, not 0.07
  CHECK(std::isnan(guided_samples(test::one_channel({a, a}, {1, 2}), nullptr).means.u[0][0]));
}

TEST_CASE("Partners by symmetry are places of the same sample, and only by a flag") {
  Dataset data = test::one_channel({{30_deg, 0_deg, 50_deg, 140_deg}}, {1});
  CHECK(guided_samples(data, nullptr).places->size() == 1);
  data.symmetry.bilateral = true;
  CHECK(guided_samples(data, nullptr).places->size() == 2);
  data.symmetry.reciprocal = data.symmetry.isotropic = true;
  const GuidedSamples all = guided_samples(data, nullptr);
  CHECK(all.places->size() == 4);
  CHECK(all.means.size() == 1);
}

TEST_CASE("A partner that was measured too is averaged with the sample") {
  Dataset data = test::one_channel({{30_deg, 0_deg, 50_deg, 140_deg}, {50_deg, 140_deg, 30_deg, 0_deg}}, {1, 3});
  CHECK(guided_samples(data, nullptr).means.size() == 2);
  data.symmetry.reciprocal = true;
  const GuidedSamples both = guided_samples(data, nullptr);
  REQUIRE(both.means.size() == 1);
  CHECK(both.means.f[0][0] == 2);
  CHECK(both.places->size() == 2);
}

TEST_CASE("The rest is the ratio where the guide is above the floor and the difference where it vanishes, at values below 0 too") {
  const AnalyticBrdf guide = test::model("phong", {0, 1, 1000});  // zero off the lobe
  const Dataset data = test::one_channel({{30_deg, 0_deg, 30_deg, 180_deg}, {30_deg, 0_deg, 60_deg, 0_deg}, {30_deg, 0_deg, 70_deg, 0_deg}},
                                         {2 * guide.eval({30_deg, 0_deg, 30_deg, 180_deg})[0], 0.01, -0.003});
  const GuidedSamples out = guided_samples(data, &guide);
  const double floor = out.floor[0];
  CHECK(floor == Approx(0.0003));
  CHECK(out.rest[0][0] == Approx(1).epsilon(1e-3));
  CHECK(out.rest[0][1] == Approx(0.01 / floor));
  CHECK(out.rest[0][2] == Approx(-0.003 / floor));
}

TEST_CASE("Rows without a value are masked directions; nothing but them, or a guide of other channels, is refused") {
  const GuidedSamples out =
      guided_samples(test::one_channel({{30_deg, 0_deg, 30_deg, 180_deg}, {30_deg, 0_deg, 30_deg, 0_deg}}, {1, no_value}), nullptr);
  CHECK(out.places->size() == 1);
  CHECK(out.masked->size() == 1);
  CHECK_THROWS_AS(guided_samples(test::one_channel({{30_deg, 0_deg, 30_deg, 0_deg}}, {no_value}), nullptr), Error);
  const AnalyticBrdf rgb("lambert", rgb_channels(), {{0.1}, {0.1}, {0.1}});
  CHECK_NOTHROW(guided_samples(test::one_channel({{30_deg, 0_deg, 30_deg, 0_deg}}, {1}), nullptr));
  Dataset two = test::one_channel({{30_deg, 0_deg, 30_deg, 0_deg}}, {1});
  CHECK_THROWS_AS(guided_samples(two, &rgb), Error);
}

TEST_CASE("A sample at normal incidence belongs to every azimuth of an isotropic surface") {
  Dataset data = test::one_channel({{0_deg, 0_deg, 40_deg, 0_deg}}, {1});
  data.symmetry.isotropic = true;
  const GuidedSamples out = guided_samples(data, nullptr);
  std::vector<Neighbour> found;
  for (const double phi : {0.0, 90.0, 200.0}) {
    out.places->around(out.place(Direction::spherical(0.01_deg, 0_deg), Direction::spherical(40_deg, degrees(phi))), {.most = 1}, found);
    CHECK(std::sqrt(found[0].squared) * out.spacing.s < 0.06);  // half of 10° at 40°
  }
}

TEST_CASE("Against another guide the samples are what they are against it from the first") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  const AnalyticBrdf one = test::model("phong", {0.3, 0.2, 100}), other = test::model("lambert", {0.2});
  const auto data = test::measured(one, test::planned({}), test::Noise{}, random);
  const GuidedSamples first = guided_samples(*data, &other), second = with_guide(guided_samples(*data, &one), &other);
  CHECK(first.floor == second.floor);
  CHECK(first.rest == second.rest);
  CHECK(first.scale == second.scale);
  CHECK(first.mean_of == second.mean_of);
  const GuidedSamples none = with_guide(guided_samples(*data, &one), nullptr);
  CHECK(none.rest == guided_samples(*data, nullptr).rest);
}
