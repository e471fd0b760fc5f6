// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/difference_image.hpp"

#include <cmath>

#include "brdf/analytic_brdf.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

constexpr std::size_t size = 21;  // odd: the centre is a pixel

std::shared_ptr<const Brdf> lobe(double s) { return std::make_shared<AnalyticBrdf>(test::lobe("phong", .2, .3, s)); }

}  // namespace

TEST_CASE("A disc has the normal in its middle, the light's side left, and nothing outside") {
  CHECK_FALSE(disc_direction(0, 0, size));
  CHECK(disc_direction(10, 10, size)->theta_o.degrees() == 0);
  const auto left = disc_direction(10, 0, size), right = disc_direction(10, 20, size), below = disc_direction(20, 10, size);
  CHECK(std::fabs(left->turn.degrees()) < 1e-9);
  CHECK(std::fabs(std::fabs(right->turn.degrees()) - 180) < 1e-9);
  CHECK(std::fabs(below->turn.degrees() - 90) < 1e-9);
  CHECK(std::fabs(right->theta_o.degrees() - 90.0 * 20 / 21) < 1e-9);
}

TEST_CASE("Two models differ where their lobes do: at the mirror direction, not on the light's side") {
  const CompareSubject a{lobe(50), nullptr}, b{lobe(100), nullptr};
  const ComparedValues values = compared_values(a, b, 80_deg);
  const DifferenceImage image = difference_image(a, b, values, size);
  REQUIRE(image.discs.size() == 5);
  REQUIRE(image.mean.size() == size * image.width());
  const std::size_t disc = 2;  // 45°
  CHECK(image.discs[disc].theta_i_deg == 45);
  const auto pixel = [&](std::size_t row, std::size_t column) { return image.mean[row * image.width() + disc * size + column]; };
  CHECK(pixel(10, 15) > 0.3f);
  CHECK(std::fabs(pixel(10, 3)) < 1e-3f);
  CHECK(std::isnan(pixel(0, 0)));
  CHECK(image.differences[0][10 * image.width() + disc * size + 15] == pixel(10, 15));
}

TEST_CASE("Samples show where there are some, and nothing elsewhere") {
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  for (int k = 0; k < 8; ++k) data->angles.push_back({30_deg, 50_deg, degrees(10.0 * k), 230_deg});
  data->f = {std::vector<double>(8, 0.2)};
  const CompareSubject a{nullptr, data},
      b{std::make_shared<AnalyticBrdf>("lambert", single_channel("Y"), std::vector<std::vector<double>>{{.3}}), nullptr};
  const DifferenceImage image = difference_image(a, b, compared_values(a, b, 80_deg), size);
  REQUIRE(image.discs.size() == 1);
  CHECK(image.discs[0].phi_i_deg == 50);
  CHECK(image.mean[10 * size + 15] < 0);         // the mirror side was measured
  CHECK(std::isnan(image.mean[10 * size + 3]));  // the light's side was not
}
