// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/square_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("Points of the square lie in the cells that dividing them one by one gives, those beyond it at its border") {
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  constexpr std::size_t rows = 5, columns = 9;
  SquareColumn y, x;
  SquareCells cells;
  for (int round = 0; round < 100; ++round) {
    for (SquareColumn* column : {&y, &x})
      for (std::size_t k = 0; k < square_batch; ++k) {
        const double at = test::uniform(random, -0.2, 1.2);
        (*column)[k] = k % 3 == 0 ? std::round(8 * at) / 8 : at;
      }
    find_square_cells(y, x, square_batch, rows, columns, cells);
    for (std::size_t k = 0; k < square_batch; ++k) {
      const double at_y = std::clamp(y[k] * (rows - 1), 0.0, rows - 1.0), at_x = std::clamp(x[k] * (columns - 1), 0.0, columns - 1.0);
      const std::size_t row = std::min(static_cast<std::size_t>(at_y), rows - 2),
                        column = std::min(static_cast<std::size_t>(at_x), columns - 2);
      CHECK(cells.row[k] == row);
      CHECK(cells.node[k] == row * columns + column);
      CHECK(cells.y[k] == at_y - static_cast<double>(row));
      CHECK(cells.x[k] == at_x - static_cast<double>(column));
    }
  }
}

TEST_CASE("A coordinate that is not a number gives a place in a cell that is none, and the cell is one of the grid") {
  SquareColumn y{}, x{};
  y[1] = x[2] = std::numeric_limits<double>::quiet_NaN();
  SquareCells cells;
  find_square_cells(y, x, 3, 4, 6, cells);
  CHECK(cells.node[0] == 0);
  CHECK(std::isnan(cells.y[1]));
  CHECK(cells.x[1] == 0);
  CHECK(std::isnan(cells.x[2]));
  for (std::size_t k = 0; k < 3; ++k) CHECK(cells.node[k] + 6 + 1 < 4 * 6);
}
