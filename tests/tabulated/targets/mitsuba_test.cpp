// SPDX-License-Identifier: BSD-3-Clause
// The numbers of an exported Mitsuba scene, read back, make the fitted function.
#include "tests/random_directions.hpp"
#include "tests/tabulated/targets/exported.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

std::vector<double> value(const std::string& text, const std::string& name) {
  return test::after(text, "name=\"" + name + "\" value=\"", "\"");
}

/// Values in the order of the formula.
ChannelValues read_back(const std::string& text) {
  if (text.find("type=\"roughplastic\"") != std::string::npos)
    return test::rows(
        {value(text, "diffuse_reflectance"), value(text, "specular_reflectance"), value(text, "alpha"), value(text, "int_ior")});
  if (text.find("type=\"principled\"") != std::string::npos)
    return test::rows(
        {value(text, "base_color"), value(text, "roughness"), value(text, "metallic"), value(text, "eta"), value(text, "anisotropic")});
  const double u = value(text, "alpha_u")[0], v = value(text, "alpha_v")[0];
  return test::rows(
      {value(text, "reflectance"), value(text, "eta"), value(text, "k"), {std::sqrt(u * v)}, {std::sqrt(v / u)}, value(text, "weight")});
}

}  // namespace

TEST_CASE("an exported Mitsuba scene reads back as the fitted function") {
  for (const auto& form : test::target_named("mitsuba").forms)
    for (const LobeSummary& summary : test::summaries()) {
      const ChannelValues values = form.formula.starts(summary).front();
      const EvaluateFormula wanted = form.formula.prepare(values), got = form.formula.prepare(read_back(form.text({values, {"a remark"}})));
      test::Random random(test::seed);
      for (int k = 0; k < 100; ++k) {
        const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
        double a[3], b[3];
        got(wi, wo, a);
        wanted(wi, wo, b);
        INFO(form.formula.name << ", seed " << test::seed);
        for (int c = 0; c < 3; ++c) CHECK(a[c] == Approx(b[c]).epsilon(1e-9));
      }
    }
}
