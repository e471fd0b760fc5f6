// SPDX-License-Identifier: BSD-3-Clause
// Models without their types: sums, their parameter tables, albedos.
#include "brdf/model_info.hpp"

#include "brdf/analytic_brdf.hpp"
#include "brdf/error.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("a sum of models has one diffuse part, the lobes of every term and unique names") {
  const ModelInfo& sum = model_info("blinn-phong+phong+blinn-phong");
  std::vector<std::string> names;
  for (const Parameter& parameter : sum.parameters) names.emplace_back(parameter.name);
  CHECK(names == std::vector<std::string>{"rho_d", "rho_s", "rho_s_2", "rho_s_3", "s", "s_2", "s_3"});
  CHECK(sum.linear_count == 4);
  CHECK(sum.depends_on == DependsOn::all);
  CHECK(model_info("blinn-phong+blinn-phong").depends_on == DependsOn::theta_h);
  CHECK(&model_info("blinn-phong+phong+blinn-phong") == &sum);
}

TEST_CASE("a sum evaluates to the sum of its terms") {
  const AnalyticBrdf sum("blinn-phong+phong", single_channel("Y"), {{.2, .3, .1, 20, 300}});
  const AnalyticBrdf broad("blinn-phong", single_channel("Y"), {{.2, .3, 20}}), narrow("phong", single_channel("Y"), {{0, .1, 300}});
  test::Random random(test::seed);
  for (int k = 0; k < 500; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    CHECK(sum.eval(wi, wo)[0] == Approx(broad.eval(wi, wo)[0] + narrow.eval(wi, wo)[0]).epsilon(1e-14));
  }
  CHECK(sum.directional_albedo(40_deg)[0] ==
        Approx(broad.directional_albedo(40_deg)[0] + narrow.directional_albedo(40_deg)[0]).epsilon(1e-14));
  CHECK(sum.albedo_bound()[0] == Approx(broad.albedo_bound()[0] + narrow.albedo_bound()[0]).epsilon(1e-14));
}

TEST_CASE("a name that is no model, or a term that adds nothing, is refused with every fault") {
  CHECK_FALSE(is_model("blinn-phong+"));
  CHECK_FALSE(is_model(""));
  CHECK(is_model("phong+phong"));
  try {
    model_info("phong+nothing+lambert");
    FAIL("accepted");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::usage);
    CHECK(error.faults().size() == 2);
  }
}
