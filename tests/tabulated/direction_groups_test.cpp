// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/direction_groups.hpp"

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr double tolerance = 1e-5;

}  // namespace

TEST_CASE("Directions within the tolerance are one group, founded by the first") {
  const std::vector<Direction> directions{Direction::spherical(30_deg, 0_deg), Direction::spherical(40_deg, 0_deg),
                                          Direction::spherical(degrees(30.0004), 0_deg), Direction::spherical(degrees(30.001), 0_deg),
                                          Direction::spherical(30_deg, 360_deg)};
  const DirectionGroups groups = group_directions(directions, tolerance);
  CHECK(groups.first == std::vector<std::size_t>{0, 1, 3});
  CHECK(groups.group == std::vector<std::size_t>{0, 1, 0, 2, 0});
}

TEST_CASE("At the pole every azimuth is the same direction") {
  std::vector<Direction> directions;
  for (int k = 0; k < 19; ++k) directions.push_back(Direction::spherical(0_deg, degrees(-90 + 10 * k)));
  CHECK(group_directions(directions, tolerance).first.size() == 1);
}

TEST_CASE("The hash finds what comparing all pairs finds") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  constexpr double wide = 0.05;  // so that groups of many members form
  std::vector<Direction> directions;
  for (int k = 0; k < 2000; ++k) directions.push_back(test::upper_direction(random));
  const DirectionGroups groups = group_directions(directions, wide);
  std::vector<std::size_t> first, group;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    std::size_t found = first.size();
    for (std::size_t g = 0; g < first.size() && found == first.size(); ++g) {
      const Direction &a = directions[first[g]], &b = directions[k];
      if (std::hypot(a.x() - b.x(), a.y() - b.y(), a.z() - b.z()) < wide) found = g;
    }
    if (found == first.size()) first.push_back(k);
    group.push_back(found);
  }
  CHECK(groups.first == first);
  CHECK(groups.group == group);
  CHECK(first.size() < 1900);
}
