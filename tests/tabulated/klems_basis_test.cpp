// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/klems_basis.hpp"

#include <cmath>
#include <numbers>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("The three bases have 145, 77 and 41 patches that fill the hemisphere") {
  const std::pair<const KlemsBasis*, std::size_t> bases[] = {
      {&KlemsBasis::full(), 145}, {&KlemsBasis::half(), 77}, {&KlemsBasis::quarter(), 41}};
  for (const auto& [basis, count] : bases) {
    CHECK(basis->size() == count);
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += basis->projected_solid_angle(k);
    CHECK(sum == Approx(std::numbers::pi).epsilon(1e-14));
    CHECK(KlemsBasis::standard(basis->name()) == basis);
  }
  CHECK(KlemsBasis::standard("lbnl/klems full") == &KlemsBasis::full());
  CHECK(KlemsBasis::standard("LBNL/Klems") == nullptr);
}

TEST_CASE("A direction lies in the patch whose centre is its own, and counting directions gives the solid angles") {
  const KlemsBasis& basis = KlemsBasis::full();
  for (std::size_t k = 0; k < basis.size(); ++k) {
    const Direction centre = Direction::spherical(basis.centre_theta(k), basis.centre_phi(k));
    CHECK(basis.patch_of(centre.x(), centre.y(), centre.z()) == k);
  }
  test::Random random(test::seed);
  std::vector<double> count(basis.size());
  constexpr int n = 400000;
  for (int k = 0; k < n; ++k) {  // uniform in projected solid angle
    const double r = std::sqrt(test::uniform(random, 0, 1)), phi = test::uniform(random, -std::numbers::pi, std::numbers::pi);
    count[*basis.patch_of(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r))] += 1;
  }
  for (std::size_t k = 0; k < basis.size(); ++k) {
    const double expected = n * basis.projected_solid_angle(k) / std::numbers::pi;
    CHECK(std::fabs(count[k] - expected) < 5 * std::sqrt(expected));
  }
}

TEST_CASE("Patches are numbered ring by ring, counter-clockwise from azimuth 0, and know their opposite and mirror image") {
  const KlemsBasis& basis = KlemsBasis::full();
  CHECK(basis.patch_of(0, 0, 1) == 0);
  const auto at = [&](double theta, double phi) {
    const Direction d = Direction::spherical(degrees(theta), degrees(phi));
    return *basis.patch_of(d.x(), d.y(), d.z());
  };
  CHECK(at(10, 0) == 1);
  CHECK(at(10, 22) == 1);
  CHECK(at(10, 23) == 2);
  CHECK(at(10, -22) == 1);
  CHECK(at(10, -23) == 8);
  CHECK(at(20, 0) == 9);
  CHECK(at(90, 0) == 133);
  CHECK(basis.opposite(at(40, 30)) == at(40, 210));
  CHECK(basis.mirrored(at(40, 30)) == at(40, -30));
  CHECK(basis.mirrored(at(40, 0)) == at(40, 0));
  CHECK(basis.opposite(0) == 0);
}

TEST_CASE("A basis that ends above the horizon has no patch beyond") {
  const KlemsBasis basis("short", {{0, 30, 1}, {30, 60, 3}});
  CHECK(basis.patch_of(std::sin(1.1), 0, std::cos(1.1)) == std::nullopt);
  CHECK(basis.patch_of(std::sin(0.9), 0, std::cos(0.9)) == 1);
  CHECK(basis.opposite(1) == std::nullopt);
}
