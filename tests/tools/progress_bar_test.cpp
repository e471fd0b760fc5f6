// SPDX-License-Identifier: BSD-3-Clause
#include "tools/progress_bar.hpp"

#include "tests/check.hpp"

using gonio::tools::progress_line;

TEST_CASE("a line of progress tells how far it is and how long it will take") {
  CHECK(progress_line("fit", 5, 20, 5, 10, "") == "fit [#####...............] 5 of 20, 30.0 s left");
  // Pieces that cost nothing do not promise that the others will not.
  CHECK(progress_line("fit", 10, 20, 5, 10, "1 failed") == "fit [##########..........] 10 of 20, 20.0 s left, 1 failed");
  CHECK(progress_line("fit", 3, 20, 0, 1, "") == "fit [###.................] 3 of 20, time unknown");
  CHECK(progress_line("fit", 0, 0, 0, 0, "") == "fit [####################] 0 of 0, time unknown");
}
