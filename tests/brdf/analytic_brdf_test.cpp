// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/analytic_brdf.hpp"

#include <cmath>
#include <limits>

#include "brdf/error.hpp"
#include "brdf/models.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("a model by name gives the same values as its type") {
  const AnalyticBrdf brdf("blinn-phong", rgb_channels(), {{0.1, 0.2, 30}, {0.2, 0.3, 30}, {0.3, 0.4, 30}});
  const GonioAngles angles{40_deg, 10_deg, 55_deg, 170_deg};
  const auto from_angles = brdf.eval(angles);
  const auto from_vectors = brdf.eval(angles.wi(), angles.wo());
  REQUIRE(from_angles.size() == 3);
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(from_angles[c] == evaluate<BlinnPhong>(lobe_geometry(angles), brdf.values()[c].data()));
    CHECK(from_vectors[c] == Approx(from_angles[c]).epsilon(1e-12));
  }
}

TEST_CASE("a model is 0 below the horizon and does not include the cosine") {
  const AnalyticBrdf brdf("lambert", single_channel("value"), {{0.5}});
  CHECK(brdf.eval(Direction::spherical(91_deg, 0_deg), Direction::spherical(10_deg, 0_deg))[0] == 0);
  CHECK(brdf.eval(Direction::spherical(80_deg, 0_deg), Direction::spherical(85_deg, 0_deg))[0] == Approx(0.5 / std::numbers::pi));
}

TEST_CASE("the customary Blinn-Phong normalisation breaks energy where the issue says so") {
  const AnalyticBrdf brdf("blinn-phong", single_channel("value"), {{0.05, 0.93, 8.764}});
  CHECK(brdf.albedo_bound()[0] == Approx(1.0499).margin(5e-5));
  CHECK(brdf.directional_albedo(0_deg)[0] == Approx(brdf.albedo_bound()[0]).epsilon(1e-12));
  const AnalyticBrdf exact("blinn-phong-exact", single_channel("value"), {{0.05, 0.93, 8.764}});
  CHECK(exact.albedo_bound()[0] == Approx(0.98));
}

TEST_CASE("unusable parameters are refused, all at once") {
  const auto faults = [](const std::string& model, std::vector<std::vector<double>> values) -> std::size_t {
    try {
      AnalyticBrdf(model, single_channel("value"), std::move(values));
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::usage);
      return error.faults().size();
    }
    return 0;
  };
  CHECK(faults("blinn-phong", {{-1, 0.2, -5}}) == 2);
  CHECK(faults("blinn-phong", {{0.1, std::numeric_limits<double>::quiet_NaN(), 5}}) == 1);
  CHECK(faults("blinn-phong", {{0.1}}) == 1);
  CHECK(faults("no-such-model", {{0.1}}) == 1);
  CHECK(faults("blinn-phong", {{0.1, 0.2, 5}}) == 0);
}
