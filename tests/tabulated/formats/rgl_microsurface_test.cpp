// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/rgl_microsurface.hpp"

#include <cmath>
#include <numbers>

#include "tests/check.hpp"

using namespace gonio::tabulated;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t columns = 128;

double theta_at(std::size_t column) {
  const double u = double(column) / double(columns - 1);
  return u * u * pi / 2;
}

/// Normals of GGX, and the projected area cos theta (1 + Lambda) that goes with them.
double ggx_density(double theta, double alpha) {
  const double c = std::cos(theta) * std::cos(theta), a = alpha * alpha;
  return a / (pi * std::pow(c * (a - 1) + 1, 2));
}
double ggx_area(double theta, double alpha) {
  const double c = std::cos(theta), s = std::sin(theta);
  return (c + std::sqrt(c * c + alpha * alpha * s * s)) / 2;
}

}  // namespace

TEST_CASE("The distribution behind the retro-reflection of a microfacet surface is found again") {
  for (const double alpha : {0.1, 0.3, 0.6})
    for (const std::size_t rows : {std::size_t{2}, std::size_t{65}}) {
      const std::size_t azimuths = rows == 2 ? 1 : rows - 1;
      std::vector<double> retro;
      for (std::size_t p = 0; p < azimuths; ++p)
        for (std::size_t k = 0; k < columns; ++k) retro.push_back(ggx_density(theta_at(k), alpha) / (4 * ggx_area(theta_at(k), alpha)));
      const Microsurface surface = microsurface_of(retro, rows, columns, 2);
      REQUIRE(surface.ndf.size() == rows * columns);
      REQUIRE(surface.sigma.size() == rows * columns);
      for (std::size_t k = 0; k < rows * columns; k += 9) {
        const double theta = theta_at(k % columns);
        INFO(alpha << " " << rows << " " << theta);
        CHECK(std::fabs(double(surface.sigma[k]) / ggx_area(theta, alpha) - 1) < 0.02);
        if (ggx_density(theta, alpha) > 1e-3 * ggx_density(0, alpha))
          CHECK(std::fabs(double(surface.ndf[k]) / ggx_density(theta, alpha) - 1) < 0.05);
      }
    }
}

TEST_CASE("Incidences lie so that sigma falls by equal steps") {
  std::vector<double> retro;
  for (std::size_t k = 0; k < columns; ++k) retro.push_back(ggx_density(theta_at(k), 0.02) / (4 * ggx_area(theta_at(k), 0.02)));
  const auto narrow = incidences_of(microsurface_of(retro, 2, columns, 1), 8);
  REQUIRE(narrow.size() == 8);
  // sigma of a smooth surface is cos theta.
  for (std::size_t k = 0; k < 8; ++k) CHECK(std::fabs(std::cos(double(narrow[k])) - (1 - double(k) / 7)) < 0.02);

  Microsurface flat{.rows = 2, .columns = columns, .ndf = std::vector<float>(256, 1), .sigma = std::vector<float>(256, 1)};
  const auto even = incidences_of(flat, 5);
  for (std::size_t k = 0; k < 5; ++k) CHECK(std::fabs(double(even[k]) - double(k) * pi / 8) < 1e-3);
}
