// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/angle_list.hpp"

#include <cmath>
#include <vector>

#include "tests/check.hpp"

using namespace gonio::tabulated;

TEST_CASE("Between two angles the weight is the part of the way; outside nothing is known") {
  const std::vector<double> list{0, 10, 30};
  const Bracket inside = bracket(list, 15);
  CHECK(inside.low == 1);
  CHECK(inside.high == 2);
  CHECK(inside.weight == 0.25);
  CHECK(bracket(list, 0).known);
  CHECK(bracket(list, 30).known);
  CHECK(bracket(list, 30 + 1e-12).known);
  CHECK_FALSE(bracket(list, 31).known);
  CHECK_FALSE(bracket(list, -1).known);
  CHECK_FALSE(bracket(list, std::nan("")).known);
  CHECK_FALSE(bracket({}, 0).known);
}

TEST_CASE("Azimuths go round; a gap as wide as those between is bridged, a missing half is not") {
  const std::vector<double> turn{0, 90, 180, 270}, half{0, 90, 180}, one{0};
  const Bracket across = bracket_azimuth(turn, -45);
  CHECK(across.known);
  CHECK(across.low == 3);
  CHECK(across.high == 0);
  CHECK(across.weight == 0.5);
  CHECK(bracket_azimuth(turn, 720 + 90).low == 1);
  CHECK(bracket_azimuth(half, 270).known);  // 180 degrees are no more than twice 90
  CHECK_FALSE(bracket_azimuth(std::vector<double>{0, 30, 60}, 200).known);
  CHECK(bracket_azimuth(one, 123).known);
  CHECK(bracket_azimuth(std::vector<double>{0, 180, 360}, 359.5).high == 2);
}
