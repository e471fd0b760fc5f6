// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/imposed_symmetry.hpp"

#include <cmath>
#include <limits>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

/// Neither reciprocal nor mirror symmetric nor isotropic: 1 + a quarter of cos theta_i + a tenth of sin(phi_o) + a fifth of cos 2 phi_i.
class Lopsided final : public UncertainBrdf {
 public:
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {}; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override {
    std::vector<double> u(f.size());
    std::vector<Coverage> coverage(wi.size());
    eval_with_uncertainty(wi, wo, f, u, coverage);
  }
  void eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f, std::span<double> u,
                             std::span<Coverage> coverage) const override {
    for (std::size_t k = 0; k < wi.size(); ++k) {
      const bool above = wi[k].z() > 0 && wo[k].z() > 0;
      f[k] = above ? 1 + wi[k].z() / 4 + wo[k].y() / 10 + std::cos(2 * wi[k].phi().radians()) / 5 : 0;
      u[k] = 0.01;
      coverage[k] = above ? (wi[k].z() < 0.5 ? Coverage::extrapolated : Coverage::measured) : Coverage::unknown;
    }
  }

 private:
  Channels channels_ = single_channel("value");
};

std::shared_ptr<const ImposedBrdf> imposed(Symmetry what) {
  const auto base = std::make_shared<const Lopsided>();
  return std::make_shared<const ImposedBrdf>(base, base, what);
}

}  // namespace

TEST_CASE("What is imposed holds to rounding, what is not stays as it was") {
  INFO("seed " << test::seed);
  test::Random random(test::seed);
  const auto isotropic = imposed({true, false, false}), bilateral = imposed({false, true, false}),
             reciprocal = imposed({false, false, true});
  const auto mirror = [](const Direction& d) { return Direction::trusted(d.x(), -d.y(), d.z()); };
  const auto quarter = [](const Direction& d) { return Direction::trusted(-d.y(), d.x(), d.z()); };
  double broken = 0;
  for (int k = 0; k < 300; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    CHECK(reciprocal->eval(wi, wo)[0] == Approx(reciprocal->eval(wo, wi)[0]).epsilon(1e-13));
    CHECK(bilateral->eval(wi, wo)[0] == Approx(bilateral->eval(mirror(wi), mirror(wo))[0]).epsilon(1e-13));
    CHECK(isotropic->eval(wi, wo)[0] == Approx(isotropic->eval(quarter(wi), quarter(wo))[0]).epsilon(1e-13));
    broken = std::max(broken, std::fabs(bilateral->eval(wi, wo)[0] - bilateral->eval(wo, wi)[0]));
  }
  CHECK(broken > 0.05);
  CHECK(reciprocal->symmetry() == Symmetry{false, false, true});
}

TEST_CASE("A masked direction takes its partner's value, and the scatter of partners is in the uncertainty") {
  const auto reciprocal = imposed({false, false, true});
  const Direction steep = Direction::spherical(20_deg, 0_deg), grazing = Direction::spherical(75_deg, 0_deg);
  const Lopsided base;
  CHECK(reciprocal->eval(grazing, steep)[0] == base.eval(steep, grazing)[0]);
  double f, u;
  Coverage coverage;
  reciprocal->eval_with_uncertainty({&grazing, 1}, {&steep, 1}, {&f, 1}, {&u, 1}, {&coverage, 1});
  CHECK(coverage == Coverage::measured);
  CHECK(u == 0.01);
  const Direction other = Direction::spherical(50_deg, 0_deg);
  reciprocal->eval_with_uncertainty({&other, 1}, {&steep, 1}, {&f, 1}, {&u, 1}, {&coverage, 1});
  CHECK(u == Approx(std::fabs(base.eval(other, steep)[0] - base.eval(steep, other)[0]) / 2));
  const Direction below = Direction::spherical(100_deg, 0_deg);
  CHECK(reciprocal->eval(below, steep)[0] == 0);
}

TEST_CASE("The change is told by its mean, its 95th percentile, its largest value and the place of that") {
  const auto bilateral = imposed({false, true, false});
  std::vector<GonioAngles> pairs;
  std::vector<double> before;
  const Lopsided base;
  for (int phi = 0; phi < 360; phi += 10) {
    pairs.push_back({20_deg, 0_deg, 60_deg, degrees(phi)});
    before.push_back(base.eval(pairs.back().wi(), pairs.back().wo())[0]);
  }
  before[0] = std::numeric_limits<double>::quiet_NaN();
  const SymmetryChange change = symmetry_change(pairs, before, *bilateral);
  CHECK(change.n == 35);
  CHECK(change.n_left_out == 1);
  CHECK(change.largest_at.phi_o.degrees() == 270);
  CHECK(change.largest == Approx(std::log(1.43492 / (1.43492 - 0.0866025))).epsilon(1e-4));
  CHECK(change.mean < change.p95);
  CHECK(change.n_changed == 34);  // all but 180°, in the plane
  CHECK(symmetry_change(pairs, before, base).largest == 0);
}
