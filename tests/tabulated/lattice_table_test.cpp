// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/lattice_table.hpp"

#include <cmath>
#include <limits>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr LatticeCoordinates every_kind[] = {LatticeCoordinates::spherical, LatticeCoordinates::specular,
                                             LatticeCoordinates::half_difference, LatticeCoordinates::distorted, LatticeCoordinates::beta};

std::vector<double> steps(double last, int count) {
  std::vector<double> out;
  for (int k = 0; k <= count; ++k) out.push_back(last * k / count);
  return out;
}

Lattice lattice(LatticeCoordinates kind, bool isotropic) {
  Lattice out;
  out.coordinates = kind;
  out.nodes_deg = {steps(85, 17), isotropic ? std::vector<double>{0} : steps(330, 11),
                   steps(kind == LatticeCoordinates::specular ? 180 : 85, 36), steps(355, 71)};
  if (kind == LatticeCoordinates::beta) {
    out.nodes_deg[2] = steps(2, 100);
    return out;
  }
  if (!isotropic) out.nodes_deg[2] = steps(kind == LatticeCoordinates::specular ? 170 : 85, 17), out.nodes_deg[3] = steps(345, 23);
  return out;
}

/// Smooth, isotropic or not, the same after wi and wo change places, and not the same on both sides of the plane of incidence.
double smooth(const Direction& wi, const Direction& wo, bool isotropic) {
  const double cross = wi.x() * wo.y() - wi.y() * wo.x();
  return 1 + 0.3 * wi.z() * wo.z() + 0.2 * dot(wi, wo) + (isotropic ? 0.1 * cross : 0.1 * (wi.x() + wo.x()));
}

LatticeTable table(const Lattice& grid, bool isotropic) {
  std::vector<double> values;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    GonioAngles at = grid.angles(k);
    // Beyond the horizon stands anything.
    values.push_back(grid.has_directions(at) ? smooth(at.wi(), at.wo(), isotropic) : 1e9);
  }
  return {grid, single_channel("value"), {values}};
}

double worst_difference(const LatticeTable& at, bool isotropic) {
  test::Random random(test::seed);
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    if (wi.z() < 0.2 || wo.z() < 0.2) continue;
    worst = std::max(worst, std::fabs(at.eval(wi, wo)[0] / smooth(wi, wo, isotropic) - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("A table gives its values at the nodes and the function between them, in every kind of coordinates") {
  // Second derivatives of at most 1 over steps of 5 and 15 degrees: (15 deg)^2 / 8 on each of the axes.
  // Beside the horizon cosines bend without bound over the sines of `beta`.
  constexpr double linear = 0.02, beside_horizon = 0.1, rounding = 1e-9;
  for (const LatticeCoordinates kind : every_kind)
    for (const bool isotropic : {true, false}) {
      INFO(static_cast<int>(kind) << isotropic);
      const LatticeTable at = table(lattice(kind, isotropic), isotropic);
      CHECK(worst_difference(at, isotropic) < (kind == LatticeCoordinates::beta ? beside_horizon : linear));
      for (std::size_t k = 0; k < at.lattice().size(); k += 1013) {
        const GonioAngles node = at.lattice().angles(k);
        // At the pole all azimuths are one direction, and interpolation takes what stands at one of them.
        if (!at.lattice().has_directions(node) || node.theta_i.degrees() < 1 || node.theta_o.degrees() < 1) continue;
        CHECK(at.eval(node.wi(), node.wo())[0] == Approx(at.values()[0][k]).epsilon(rounding));
      }
    }
}

TEST_CASE("Folded azimuths stand for their other sides") {
  constexpr double linear = 0.02;
  for (const LatticeCoordinates kind : every_kind) {
    Lattice half = lattice(kind, true);
    half.nodes_deg[3] = steps(180, 36);
    half.bilateral = true;
    const LatticeTable at = table(half, true);
    const Direction wi = Direction::spherical(30_deg, 20_deg);
    const Direction left = Direction::spherical(40_deg, 170_deg), right = Direction::spherical(40_deg, -130_deg);
    CHECK(at.eval(wi, left)[0] == Approx(at.eval(wi, right)[0]).epsilon(1e-12));
  }
  Lattice reciprocal = lattice(LatticeCoordinates::half_difference, true);
  reciprocal.nodes_deg[3] = steps(175, 35);
  reciprocal.reciprocal = true;
  // The cross product changes its sign with the exchange: a reciprocal table holds what does not.
  std::vector<double> values;
  for (std::size_t k = 0; k < reciprocal.size(); ++k) {
    const GonioAngles at = reciprocal.angles(k);
    values.push_back(1 + 0.3 * at.theta_i.cos() * at.theta_o.cos());
  }
  const LatticeTable at(reciprocal, single_channel("value"), {values});
  test::Random random(test::seed);
  for (int k = 0; k < 200; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    if (wi.z() < 0.2 || wo.z() < 0.2) continue;
    CHECK(at.eval(wi, wo)[0] == Approx(at.eval(wo, wi)[0]).epsilon(1e-9));
    CHECK(at.eval(wi, wo)[0] == Approx(1 + 0.3 * wi.z() * wo.z()).epsilon(linear));
  }
  CHECK(at.symmetry() == Symmetry{.isotropic = true, .bilateral = false, .reciprocal = true});
}

TEST_CASE("In transmission the outgoing direction is below the surface and the third angle counts from straight on") {
  Lattice grid = lattice(LatticeCoordinates::specular, true);
  grid.side = Side::transmission;
  std::vector<double> values;
  for (std::size_t k = 0; k < grid.size(); ++k) values.push_back(180 - grid.nodes_deg[2][grid.position(k)[2]]);
  const LatticeTable at(grid, single_channel("value"), {values});
  const Direction wi = Direction::spherical(30_deg, 0_deg);
  CHECK(at.eval(wi, Direction::trusted(-wi.x(), -wi.y(), -wi.z()))[0] == Approx(180).epsilon(1e-9));
  CHECK(at.eval(wi, wi)[0] == 0);
  CHECK(at.samples().angles.back().theta_o.degrees() > 90);
  CHECK(at.samples().side == Side::transmission);

  grid.offset_deg.assign(grid.nodes_deg[0].size(), -10);
  const LatticeTable refracted(grid, single_channel("value"), {values});
  CHECK(refracted.eval(wi, Direction::spherical(160_deg, 180_deg))[0] == Approx(180).epsilon(1e-9));
}

TEST_CASE("Unknown nodes and those beyond the horizon are left out; nothing is known where no other is") {
  Lattice grid = lattice(LatticeCoordinates::spherical, true);
  std::vector<double> values(grid.size(), 2.0);
  for (std::size_t k = 0; k < grid.size(); ++k)
    if (grid.nodes_deg[2][grid.position(k)[2]] > 60) values[k] = std::numeric_limits<double>::quiet_NaN();
  const LatticeTable at(grid, single_channel("value"), {values});
  const Direction wi = Direction::spherical(30_deg, 0_deg);
  CHECK(at.eval(wi, Direction::spherical(60.1_deg, 10_deg))[0] == 2);
  CHECK(std::isnan(at.eval(wi, Direction::spherical(80_deg, 10_deg))[0]));
  const Dataset samples = at.samples();
  samples.require_consistent();
  CHECK(samples.masked.nan > 0);
  // One direction at theta_o = 0, not one per azimuth.
  CHECK(samples.size() + samples.masked.nan + grid.nodes_deg[0].size() * (grid.nodes_deg[3].size() - 1) == grid.size());
}
