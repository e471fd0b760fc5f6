// SPDX-License-Identifier: BSD-3-Clause
// Laws of every renderer's formula and text, run over the list.
#include "tabulated/targets/target.hpp"

#include <cmath>

#include "brdf/error.hpp"
#include "tests/random_directions.hpp"
#include "tests/tabulated/targets/exported.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

template <class F>
void for_each_form(F&& f) {
  for (const auto& target : test::targets::render_targets())
    for (const auto& form : target.forms) f(target, form);
}

Direction mirrored(const Direction& w) { return Direction::trusted(w.x(), -w.y(), w.z()); }

}  // namespace

TEST_CASE("every formula is finite, not negative, and 0 below the horizon") {
  test::Random random(test::seed);
  for_each_form([&](const auto& target, const auto& form) {
    for (const LobeSummary& summary : test::summaries()) {
      const EvaluateFormula f = form.formula.prepare(form.formula.starts(summary).front());
      for (int k = 0; k < 400; ++k) {
        const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
        double value[3], below[3];
        f(wi, wo, value);
        f(wi, Direction::trusted(wo.x(), wo.y(), -wo.z()), below);
        INFO(target.name << ", " << form.formula.name << ", seed " << test::seed);
        for (int c = 0; c < 3; ++c) {
          CHECK(std::isfinite(value[c]));
          CHECK(value[c] >= 0);
          CHECK(below[c] == 0);
        }
      }
    }
  });
}

TEST_CASE("starts lie within the bounds, and isotropic ones give an isotropic function") {
  test::Random random(test::seed);
  for_each_form([&](const auto& target, const auto& form) {
    LobeSummary summary = test::summaries()[0];
    summary.alpha_y = summary.alpha_x;
    for (const ChannelValues& values : form.formula.starts(summary)) {
      REQUIRE(values.size() == 3);
      for (const auto& set : values) {
        REQUIRE(set.size() == form.formula.parameters.size());
        for (std::size_t p = 0; p < set.size(); ++p) {
          INFO(target.name << ", " << form.formula.name << ", " << form.formula.parameters[p].name);
          CHECK(set[p] >= form.formula.parameters[p].lower);
          CHECK(set[p] <= form.formula.parameters[p].upper);
          if (form.formula.parameters[p].if_isotropic) CHECK(set[p] == Approx(*form.formula.parameters[p].if_isotropic).margin(1e-12));
        }
      }
      const EvaluateFormula f = form.formula.prepare(values);
      const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
      const auto turned = [](const Direction& w) { return Direction::trusted(-w.y(), w.x(), w.z()); };
      double a[3], b[3], m[3];
      f(wi, wo, a);
      f(turned(wi), turned(wo), b);
      f(mirrored(wi), mirrored(wo), m);
      for (int c = 0; c < 3; ++c) {
        CHECK(b[c] == Approx(a[c]).epsilon(1e-12));
        CHECK(m[c] == Approx(a[c]).epsilon(1e-12));
      }
    }
  });
}

TEST_CASE("every form names its conventions, its source and its slots, and no template is left open in its text") {
  for_each_form([&](const auto& target, const auto& form) {
    INFO(target.name << ", " << form.formula.name);
    CHECK(!form.formula.source.empty());
    CHECK(!form.formula.roughness.empty());
    CHECK(!form.formula.shadowing.empty());
    CHECK(!form.formula.fresnel.empty());
    const std::string text = form.text({form.formula.starts(test::summaries()[0]).front(), {"a remark"}});
    CHECK(text.find("{{") == std::string::npos);
    CHECK(text.find("a remark") != std::string::npos);
    CHECK(text.find("nan") == std::string::npos);
    CHECK(text.back() == '\n');
  });
}

TEST_CASE("numbers are written in full and as real numbers; a template with an unknown name is refused") {
  CHECK(test::targets::real(1) == "1.0");
  CHECK(test::targets::real(0.1) == "0.1");
  CHECK(test::targets::real(1e-7) == "1e-07");
  CHECK(std::stod(test::targets::real(0.1 + 0.2)) == 0.1 + 0.2);
  CHECK(test::targets::triple({1, 2.5, 3}, ", ") == "1.0, 2.5, 3.0");
  CHECK(test::targets::filled("a {{b}} c{{b}}", {{"b", "x"}}) == "a x cx");
  CHECK_THROWS_AS(test::targets::filled("{{c}}", {{"b", "x"}}), Error);
  CHECK_THROWS_AS(test::targets::filled("{{b", {{"b", "x"}}), Error);
}

TEST_CASE("docs/renderers.md has a row for every target and every material") {
  const std::string page = test::read_file(GONIO_SOURCE "/docs/renderers.md");
  REQUIRE(!page.empty());
  for_each_form([&](const auto& target, const auto& form) {
    INFO(target.name << ", " << form.formula.name);
    CHECK(page.find("| `" + std::string(target.name) + "`") != std::string::npos);
    CHECK((page.find("| " + std::string(form.formula.name) + " |") != std::string::npos || target.forms.size() == 1));
  });
}
