// SPDX-License-Identifier: BSD-3-Clause
// Tables that can be evaluated anywhere: symmetry of the table told from its noise, cell by cell.
#include "fitting/checks/table_symmetry.hpp"

#include <cmath>
#include <cstdint>
#include <functional>

#include "fitting/checks/sample_places.hpp"
#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// A lobe times a factor, with noise that is the same over cells of 2° in every angle.
class Table final : public Brdf {
 public:
  using Factor = std::function<double(const GonioAngles&)>;
  Table(double noise, Symmetry symmetry, Factor factor = {}) : noise_(noise), symmetry_(symmetry), factor_(std::move(factor)) {}
  const Channels& channels() const override { return model_.channels(); }
  Symmetry symmetry() const override { return symmetry_; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override {
    for (std::size_t k = 0; k < wi.size(); ++k) {
      const GonioAngles a = gonio_angles(wi[k], wo[k]);
      std::uint64_t hash = 1469598103934665603u;
      for (const Angle& angle : {a.theta_i, a.phi_i, a.theta_o, a.phi_o})
        hash = (hash ^ static_cast<std::uint64_t>(std::floor(angle.degrees() / 2) + 1000)) * 1099511628211u;
      std::mt19937_64 random(hash);
      f[k] = model_.eval(a)[0] * (1 + noise_ * std::normal_distribution<double>()(random)) * (factor_ ? factor_(a) : 1);
    }
  }

 private:
  AnalyticBrdf model_ = lobe("blinn-phong", .3, .2, 20);
  double noise_;
  Symmetry symmetry_;
  Factor factor_;
};

Check check_of(Check (*check)(const CheckSubject&, const CheckOptions&), double noise, const Table::Factor& factor,
               Symmetry symmetry = {}) {
  return check({{}, nullptr, std::make_shared<Table>(noise, symmetry, factor)}, {});
}

double skew(const GonioAngles& a) { return 1 + .1 * (a.theta_i.cos() - a.theta_o.cos()); }

}  // namespace

TEST_CASE("table: noise within the margin passes, above it cannot tell, an asymmetry fails through the noise") {
  const Check quiet = check_of(check_reciprocity, .005, {}), noisy = check_of(check_reciprocity, .1, {});
  const Check skewed = check_of(check_reciprocity, .05, skew);
  INFO(quiet.detail << "\n" << noisy.detail << "\n" << skewed.detail);
  CHECK(quiet.verdict == Verdict::pass);
  CHECK(noisy.verdict == Verdict::vacuous);
  CHECK(*noisy.effect == Approx(.1 * std::sqrt(2.)).epsilon(.1));
  CHECK(skewed.verdict == Verdict::fail);
  CHECK(skewed.where.size() == CheckOptions{}.where);
  CHECK(skewed.detail.find("weighted by cos θi cos θo") != std::string::npos);
}

TEST_CASE("table: the statistic is the weighted rms of the relative difference") {
  // 2 (f - f')/(f + f') = 0.2 (cos θi - cos θo) for the factor above; weights and pairs even in solid angle up to 80°.
  double square = 0, weight = 0;
  for (std::size_t k = 0; k < 20000; ++k) {
    double number = 0;
    const GonioAngles a = spread_pair(k, number);
    const double w = a.theta_i.cos() * a.theta_o.cos();
    square += w * std::pow(.2 * (a.theta_i.cos() - a.theta_o.cos()), 2), weight += w;
  }
  CHECK(*check_of(check_reciprocity, 0, skew).effect == Approx(std::sqrt(square / weight)).epsilon(.02));
}

TEST_CASE("table: bilateral symmetry and isotropy are tested the same way, and nothing that holds by construction") {
  const auto sided = [](const GonioAngles& a) { return 1 + .2 * a.theta_o.sin() * (a.phi_o - a.phi_i).sin(); };
  const auto brushed = [](const GonioAngles& a) { return 1 + .1 * std::cos(2 * a.phi_i.radians()); };
  CHECK(check_of(check_bilateral, .02, sided).verdict == Verdict::fail);
  CHECK(check_of(check_bilateral, .005, skew).verdict == Verdict::pass);
  CHECK(check_of(check_isotropy, .02, brushed).verdict == Verdict::fail);
  const Check merl = check_of(check_reciprocity, .02, skew, {.isotropic = true, .bilateral = false, .reciprocal = true});
  CHECK(merl.verdict == Verdict::vacuous);
  CHECK(merl.detail.find("cannot fail") != std::string::npos);
  CHECK(merl.detail.find("bilateral") != std::string::npos);
}

TEST_CASE("model: anything beyond rounding is seen") {
  const auto phong = std::make_shared<AnalyticBrdf>(lobe("blinn-phong", .3, .2, 20));
  Check check;
  judge_by_evaluation(check, {{}, nullptr, phong}, {}, [](const GonioAngles& a, double) { return exchanged(a); });
  CHECK(check.verdict == Verdict::pass);
  judge_by_evaluation(check, {{}, nullptr, phong}, {}, [](const GonioAngles& a, double) {
    return GonioAngles{a.theta_i, a.phi_i, a.theta_o, a.phi_o + degrees(.1)};
  });
  CHECK(check.verdict == Verdict::warn);
}
