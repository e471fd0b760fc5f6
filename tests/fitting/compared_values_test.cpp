// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/compared_values.hpp"

#include <cmath>
#include <numbers>

#include "brdf/analytic_brdf.hpp"
#include "brdf/error.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;

std::shared_ptr<const Brdf> lambert(double rho_d, Channels channels = single_channel("Y")) {
  const std::size_t count = channels.size();
  return std::make_shared<AnalyticBrdf>("lambert", std::move(channels), std::vector<std::vector<double>>(count, {rho_d}));
}

std::shared_ptr<Dataset> samples(const std::vector<double>& theta_o_deg, double f) {
  auto out = std::make_shared<Dataset>();
  out->channels = single_channel("Y");
  for (const double theta_o : theta_o_deg) out->angles.push_back({30_deg, 0_deg, degrees(theta_o), 180_deg});
  out->f = {std::vector<double>(theta_o_deg.size(), f)};
  return out;
}

}  // namespace

TEST_CASE("Channels match by name, else a single one stands against all") {
  CHECK(matched_channels(rgb_channels(), rgb_channels()).size() == 3);
  Channels two{single_channel("b").front(), single_channel("r").front()};
  const auto matched = matched_channels(rgb_channels(), two);
  REQUIRE(matched.size() == 2);
  CHECK(matched[0].name == "r");
  CHECK(matched[0].b == 1);
  CHECK(matched_channels(rgb_channels(), single_channel("value")).size() == 3);
  CHECK(matched_channels(single_channel("value"), rgb_channels())[2].b == 2);
  CHECK_THROWS_AS(matched_channels(rgb_channels(), {single_channel("x").front(), single_channel("y").front()}), Error);
}

TEST_CASE("Two sets of samples meet at their common directions, repeats averaged") {
  const auto a = samples({10, 20, 20, 30, 40}, 1.0), b = samples({40, 30, 20, 50}, 2.0);
  a->f[0][1] = 3;
  const ComparedValues values = compared_values({nullptr, a}, {nullptr, b}, 80_deg);
  CHECK(values.at == ComparedAt::common_directions);
  REQUIRE(values.angles.size() == 3);
  CHECK(values.without_partner == 1);
  CHECK(values.a.f[0][0] == 2);  // the mean of 3 and 1 at 20°
  CHECK(values.b.f[0][0] == 2);
}

TEST_CASE("Samples without common directions are held against the other side where it can be evaluated") {
  const auto a = samples({10, 20}, 1.0), b = samples({15, 25, 35}, 2.0);
  CHECK_THROWS_AS(compared_values({nullptr, a}, {nullptr, b}, 80_deg), Error);
  const ComparedValues values = compared_values({nullptr, a}, {lambert(pi), b}, 80_deg);
  CHECK(values.at == ComparedAt::samples_of_a);
  CHECK(values.other_is_samples);
  CHECK(values.angles.size() == 2);
  CHECK(std::fabs(values.b.f[0][1] - 1) < rounding);
  const ComparedValues other = compared_values({lambert(pi), nullptr}, {nullptr, b}, 80_deg);
  CHECK(other.at == ComparedAt::samples_of_b);
  CHECK(other.b.f[0][2] == 2);
  CHECK_FALSE(other.other_is_samples);
}

TEST_CASE("The quadrature's weights are the measure of the directions within the limit") {
  const auto total = [](Angle limit) {
    const ComparedValues values = compared_values({lambert(.5), nullptr}, {lambert(.4), nullptr}, limit);
    CHECK(values.at == ComparedAt::quadrature);
    double sum = 0;
    for (const double weight : values.weight) sum += weight;
    return sum;
  };
  // Both solid angles, 2 pi (1 - cos limit) each; the edge of the region cuts cells.
  constexpr double cut_cells = 5e-3;
  CHECK(std::fabs(total(80_deg) / std::pow(2 * pi * (1 - std::cos(80 * pi / 180)), 2) - 1) < cut_cells);
  CHECK(std::fabs(total(90_deg) / (4 * pi * pi) - 1) < cut_cells);
}
