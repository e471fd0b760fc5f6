// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/direction_grid.hpp"

#include <algorithm>

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr GridSize sizes[] = {GridSize::paper, GridSize::standard, GridSize::fine};
constexpr Symmetry bilateral{.isotropic = true, .bilateral = true, .reciprocal = false};
constexpr Symmetry isotropic{.isotropic = true, .bilateral = false, .reciprocal = false};

bool strictly_increasing(const std::vector<double>& list) {
  return std::adjacent_find(list.begin(), list.end(), [](double a, double b) { return !(a < b); }) == list.end();
}

}  // namespace

TEST_CASE("Every list of a grid increases, stays above the horizon and holds the mirror directions") {
  for (const GridSize size : sizes)
    for (const Symmetry& symmetry : {bilateral, isotropic, Symmetry{}}) {
      const DirectionGrid grid = direction_grid(size, symmetry);
      for (const auto* list : {&grid.theta_i_deg, &grid.phi_i_deg, &grid.theta_o_deg, &grid.phi_deg}) CHECK(strictly_increasing(*list));
      CHECK(grid.theta_i_deg.front() == 0);
      CHECK(grid.theta_o_deg.back() < 90);
      CHECK(std::includes(grid.theta_o_deg.begin(), grid.theta_o_deg.end(), grid.theta_i_deg.begin(), grid.theta_i_deg.end()));
      CHECK(std::binary_search(grid.phi_deg.begin(), grid.phi_deg.end(), 180.0));
      CHECK((grid.phi_i_deg.size() == 1) == symmetry.isotropic);
      CHECK(grid.phi_deg.back() == (symmetry.isotropic && symmetry.bilateral ? 180 : 360 - grid.phi_deg[1]));
    }
}

TEST_CASE("A larger size has more directions, and the numbers that are documented") {
  const auto count = [](GridSize size) { return direction_grid(size, bilateral).size(); };
  CHECK(count(GridSize::paper) == 3420);
  CHECK(count(GridSize::standard) == 21090);
  CHECK(count(GridSize::fine) == 116143);
  CHECK(radial_grid_deg(GridSize::paper).size() < radial_grid_deg(GridSize::standard).size());
  CHECK(radial_grid_deg(GridSize::standard).size() < radial_grid_deg(GridSize::fine).size());
}

TEST_CASE("Every pair occurs once") {
  const DirectionGrid grid = direction_grid(GridSize::paper, bilateral);
  // theta_o = 0 has one azimuth instead of all.
  CHECK(grid.pairs().size() == grid.size() - grid.theta_i_deg.size() * (grid.phi_deg.size() - 1));
}

TEST_CASE("Incident by outgoing directions of an anisotropic grid are a table") {
  const DirectionGrid grid = direction_grid(GridSize::paper, {});
  std::vector<double> phi_o;
  for (const GonioAngles& pair : grid.pairs()) phi_o.push_back(pair.phi_o.degrees());
  std::sort(phi_o.begin(), phi_o.end());
  phi_o.erase(std::unique(phi_o.begin(), phi_o.end()), phi_o.end());
  CHECK(phi_o == grid.phi_deg);
}

TEST_CASE("Angles from the mirror direction grow evenly out to half a turn") {
  for (const GridSize size : sizes) {
    const std::vector<double> radial = radial_grid_deg(size);
    CHECK(strictly_increasing(radial));
    CHECK(radial.front() == 0);
    CHECK(radial.back() == 180);
  }
}
