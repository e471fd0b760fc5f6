// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/sheet_side.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("The four sides of a sheet have WINDOW's names, and y turns over with the front") {
  CHECK(SheetSide{Side::reflection, false}.name() == "Reflection Back");
  CHECK(SheetSide{Side::reflection, true}.name() == "Reflection Front");
  CHECK(SheetSide{Side::transmission, false}.name() == "Transmission Back");
  CHECK(SheetSide{Side::transmission, true}.name() == "Transmission Front");
  CHECK(SheetSide{Side::reflection, false}.y_sign() == 1);
  CHECK(SheetSide{Side::reflection, true}.y_sign() == -1);
}

TEST_CASE("Reflection leaves on the side of the light and transmission on the other; light from below is never held") {
  const Direction above = Direction::spherical(30_deg, 20_deg), below = Direction::spherical(150_deg, 20_deg);
  for (const bool front : {false, true}) {
    const SheetSide reflection{Side::reflection, front}, transmission{Side::transmission, front};
    CHECK(reflection.holds(above, above));
    CHECK_FALSE(reflection.holds(above, below));
    CHECK(transmission.holds(above, below));
    CHECK_FALSE(transmission.holds(above, above));
    CHECK_FALSE(reflection.holds(below, above));
    CHECK_FALSE(transmission.holds(below, below));
  }
}
