// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/half_difference_table.hpp"

#include <cmath>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

using Values = std::array<std::vector<double>, 3>;

/// A table with value(cell, channel) everywhere.
template <class Value>
MerlPlanes planes_of(Value&& value) {
  Values out;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < MerlGrid::cell_count; ++k) out[c].push_back(value(MerlGrid::cell(k), c));
  return MerlPlanes::owning(std::move(out));
}

double as_double(std::size_t n) { return static_cast<double>(n); }

}  // namespace

TEST_CASE("The table gives its own numbers back at every node above the horizon") {
  const auto value = [](const MerlCell& cell, std::size_t c) { return 1 + as_double(MerlGrid::index(cell)) + 0.25 * as_double(c); };
  const MerlPlanes planes = planes_of(value);
  for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
    const HalfDifferenceTable table(planes, nodes);
    std::size_t wrong = 0, compared = 0;
    for (std::size_t k = 0; k < MerlGrid::cell_count; k += 7) {
      const MerlCell cell = MerlGrid::cell(k);
      const HalfDifference node = MerlGrid::node(cell, nodes);
      const DirectionPair pair = directions(node);
      if (!above_horizon(pair) || node.theta_h.radians() == 0 || node.theta_d.radians() == 0) continue;
      const std::vector<double> f = table.eval(pair.wi, pair.wo);
      ++compared;
      for (std::size_t c = 0; c < 3; ++c) wrong += f[c] != value(cell, c);
    }
    CHECK(compared > 80000);
    CHECK(wrong == 0);
  }
}

TEST_CASE("Between nodes the table is linear in each of its coordinates") {
  // A function linear in (sqrt theta_h, theta_d) and constant in phi_d is reproduced everywhere inside the outermost nodes.
  const HalfDifferenceTable table(
      planes_of([](const MerlCell& cell, std::size_t) { return 3 + 2 * as_double(cell.theta_h) + 5 * as_double(cell.theta_d); }),
      MerlNodes::left);
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  constexpr double rounding_only = 1e-9;  // the square root near theta_h = 0 leaves 1e-7 of a cell, of a value of 500
  for (int k = 0; k < 20000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const HalfDifference at = half_difference(wi, wo);
    const double h = 90 * std::sqrt(at.theta_h.degrees() / 90), d = at.theta_d.degrees();
    if (h > 89 || d > 89) continue;
    REQUIRE(table.eval(wi, wo)[0] == Approx(3 + 2 * h + 5 * d).epsilon(rounding_only));
  }
}

TEST_CASE("phi_d is periodic: the last cell is next to the first, and exchanged directions give the same value") {
  const HalfDifferenceTable table(
      planes_of([](const MerlCell& cell, std::size_t) { return cell.phi_d == 0     ? 2.0
                                                               : cell.phi_d == 179 ? 1.0
                                                                                   : 7.0; }), MerlNodes::left);
  const DirectionPair between = directions({degrees(10), degrees(0), degrees(30), degrees(179.5)});
  CHECK(table.eval(between.wi, between.wo)[0] == Approx(1.5).epsilon(1e-10));
  CHECK(table.eval(between.wo, between.wi)[0] == Approx(1.5).epsilon(1e-10));
}

TEST_CASE("A masked neighbour is left out, and with none left the value is unknown") {
  const HalfDifferenceTable table(planes_of([](const MerlCell& cell, std::size_t c) {
                                    if (cell.theta_h >= 40) return c == 1 ? -1.0 : 1.0;  // one negative channel masks the cell
                                    return 2.0;
                                  }),
                                  MerlNodes::left);
  const auto at = [&](double h) {
    const DirectionPair pair = directions({degrees(h * h / 90), degrees(0), degrees(10), degrees(20)});
    return table.eval(pair.wi, pair.wo);
  };
  CHECK(at(39.9) == std::vector<double>{2, 2, 2});
  CHECK(std::isnan(at(40)[0]));
  CHECK(std::isnan(at(45.5)[2]));
}

TEST_CASE("Below the horizon the table is 0") {
  const HalfDifferenceTable table(planes_of([](const MerlCell&, std::size_t) { return 1.0; }), MerlNodes::left);
  const Direction up = Direction::spherical(20_deg, 0_deg), down = Direction::spherical(100_deg, 180_deg),
                  level = Direction::spherical(90_deg, 0_deg);
  CHECK(table.eval(up, down) == std::vector<double>{0, 0, 0});
  CHECK(table.eval(down, up) == std::vector<double>{0, 0, 0});
  CHECK(table.eval(up, level) == std::vector<double>{0, 0, 0});
}

TEST_CASE("The fitter sees 90 rows of constant theta_h with the geometry of the nodes") {
  const MerlPlanes planes =
      planes_of([](const MerlCell& cell, std::size_t c) { return as_double(MerlGrid::index(cell)) - (c == 2 ? 1 : 0); });
  for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
    const auto observations = observe_merl(planes, nodes);
    REQUIRE(observations->block_count() == 90);
    CHECK(observations->symmetry().isotropic);
    CHECK(observations->symmetry().reciprocal);
    std::vector<LobeGeometry> geometry;
    std::vector<GonioAngles> angles;
    double worst_row = 0, worst_cell = 0;
    for (std::size_t row = 0; row < 90; ++row) {
      const ObservationBlock block = observations->block(row);
      REQUIRE(block.size == 16200);
      REQUIRE(block.size <= Observations::max_block);
      REQUIRE(block.constant == ConstantOver::theta_h);
      REQUIRE(block.f.size() == 3);
      REQUIRE(block.u.empty());
      REQUIRE(block.f[0][5] == as_double(row * 16200 + 5));
      const double theta_h = MerlGrid::node({row, 0, 0}, nodes).theta_h.radians();
      worst_row = std::max(worst_row, std::fabs(block.log_cos_h - std::log(std::cos(theta_h))));
      observations->geometry(row, geometry);
      observations->angles(row, angles);
      for (std::size_t k = 0; k < block.size; k += 101) {
        const DirectionPair pair = directions(MerlGrid::node(MerlGrid::cell(row * 16200 + k), nodes));
        REQUIRE(geometry[k].log_cos_h == block.log_cos_h);
        worst_cell = std::max({worst_cell, std::fabs(geometry[k].cos_i - pair.wi.z()), std::fabs(geometry[k].cos_o - pair.wo.z()),
                               angle_between(angles[k].wi(), pair.wi).radians(), angle_between(angles[k].wo(), pair.wo).radians()});
      }
    }
    CHECK(worst_row < 2e-14);  // the naive form: |log cos| near 89° amplifies the rounding of theta_h sixty times
    CHECK(worst_cell < 1e-15);
    CHECK_FALSE(observations->block(0).valid(0));  // blue is -1 there
    CHECK(observations->block(0).valid(1));
  }
}

TEST_CASE("The cosines of a row in float are those of its geometry") {
  for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
    const auto observations = observe_merl(planes_of([](const MerlCell&, std::size_t) { return 1.0; }), nodes);
    for (const std::size_t row : {std::size_t{0}, std::size_t{1}, std::size_t{40}, std::size_t{89}}) {
      std::vector<LobeGeometry> all;
      FacetGeometry facets;
      observations->geometry(row, all);
      observations->facet_geometry(row, facets);
      REQUIRE(facets.cos_i.size() == all.size());
      constexpr double one_rounding = 1e-7;
      double worst = 0;
      for (std::size_t k = 0; k < all.size(); ++k) {
        worst = std::max({worst, std::fabs(facets.cos_i[k] - all[k].cos_i), std::fabs(facets.cos_o[k] - all[k].cos_o),
                          std::fabs(facets.cos_d[k] - all[k].cos_d)});
        if (all[k].has_half_vector() && all[k].above_horizon())
          worst = std::max(worst, std::fabs(facets.tan2_h[k] / std::max(all[k].tan2_h, 1e-12) - std::min(1.0, all[k].tan2_h / 1e-12)));
      }
      INFO("row " << row);
      CHECK(worst < one_rounding);
    }
  }
}

TEST_CASE("The mirror angle of a row is that of its geometry") {
  for (const MerlNodes nodes : {MerlNodes::left, MerlNodes::centre}) {
    const auto observations = observe_merl(planes_of([](const MerlCell&, std::size_t) { return 1.0; }), nodes);
    for (const std::size_t row : {std::size_t{0}, std::size_t{1}, std::size_t{40}, std::size_t{89}}) {
      std::vector<LobeGeometry> all;
      MirrorGeometry mirror;
      observations->geometry(row, all);
      observations->mirror_geometry(row, mirror);
      REQUIRE(mirror.sin2_half_psi.size() == all.size());
      constexpr double rounding_only = 1e-14;  // of the angles of the grid
      double worst = 0;
      for (std::size_t k = 0; k < all.size(); ++k) {
        worst = std::max({worst, std::fabs(mirror.cos_i[k] - all[k].cos_i), std::fabs(mirror.cos_o[k] - all[k].cos_o)});
        if (all[k].log_cos_psi > LobeGeometry::no_lobe)
          worst = std::max(worst, std::fabs(mirror.sin2_half_psi[k] + 0.5 * std::expm1(all[k].log_cos_psi)));
        else if (all[k].above_horizon())
          worst = std::max(worst, 0.5 - mirror.sin2_half_psi[k]);
      }
      INFO("row " << row);
      CHECK(worst < rounding_only);
    }
  }
}

TEST_CASE("The half angle of the first rows keeps its digits") {
  const auto observations = observe_merl(planes_of([](const MerlCell&, std::size_t) { return 1.0; }), MerlNodes::left);
  CHECK(observations->block(0).log_cos_h == 0);
  // ln cos x = -x²/2 - x⁴/12 - ...
  const double x = degrees(1.0 / 90).radians();
  CHECK(observations->block(1).log_cos_h == Approx(-x * x / 2 - x * x * x * x / 12).epsilon(1e-15));
}
