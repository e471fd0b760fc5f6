// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/node_values.hpp"

#include <cmath>
#include <limits>

#include "tests/random_directions.hpp"
#include "tests/tabulated/faults_text.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

struct Pairs {
  std::vector<Direction> wi, wo;
};

Pairs random_pairs(std::size_t n) {
  test::Random random(test::seed);
  Pairs out;
  for (std::size_t k = 0; k < n; ++k) out.wi.push_back(test::upper_direction(random)), out.wo.push_back(test::upper_direction(random));
  return out;
}

/// wo.x in one channel: NaN below -0.8, infinite above `infinite_above`, extrapolated above 0.5, and 1 % sure of itself.
class Ramp final : public UncertainBrdf {
 public:
  explicit Ramp(double infinite_above = 2) : infinite_above_(infinite_above) {}
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {}; }
  using Brdf::eval;
  void eval(std::span<const Direction>, std::span<const Direction> wo, std::span<double> f) const override {
    for (std::size_t k = 0; k < wo.size(); ++k) {
      const double x = wo[k].x();
      f[k] = x < -0.8 ? std::numeric_limits<double>::quiet_NaN() : x > infinite_above_ ? std::numeric_limits<double>::infinity() : x;
    }
  }
  void eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f, std::span<double> u,
                             std::span<Coverage> coverage) const override {
    eval(wi, wo, f);
    for (std::size_t k = 0; k < wo.size(); ++k) {
      u[k] = 0.01 * std::abs(f[k]);
      coverage[k] = std::isnan(f[k]) ? Coverage::unknown : wo[k].x() > 0.5 ? Coverage::extrapolated : Coverage::interpolated;
    }
  }

 private:
  double infinite_above_;
  Channels channels_ = single_channel("value");
};

}  // namespace

TEST_CASE("Values at the nodes are those of the BRDF, and what was met is counted") {
  const auto pairs = random_pairs(20000);
  Opened source;
  source.brdf = std::make_shared<const Ramp>();
  std::size_t unknown = 0, negative = 0, extrapolated = 0;
  for (const Direction& wo : pairs.wo) unknown += wo.x() < -0.8, negative += wo.x() >= -0.8 && wo.x()<0, extrapolated += wo.x()> 0.5;
  REQUIRE(unknown * negative * extrapolated > 0);

  ExportNotes notes;
  const NodeValues plain = node_values(source, pairs.wi, pairs.wo, 2, notes);
  CHECK(notes.n_nodes == 20000);
  CHECK(notes.n_unknown == unknown);
  CHECK(notes.n_negative == negative);
  CHECK(notes.n_extrapolated == 0);
  CHECK(plain.u.empty());
  CHECK(plain.coverage.empty());

  source.uncertain = std::make_shared<const Ramp>();
  ExportNotes more;
  const NodeValues values = node_values(source, pairs.wi, pairs.wo, 1, more);
  CHECK(more.n_extrapolated == extrapolated);
  for (std::size_t k = 0; k < values.f.size(); ++k)
    if (values.coverage[k] != Coverage::unknown) {
      CHECK(values.f[k] == pairs.wo[k].x());
      CHECK(plain.f[k] == values.f[k]);
      CHECK(values.u[k] == 0.01 * std::abs(values.f[k]));
    }
}

TEST_CASE("An infinite value and a source without a BRDF are refused") {
  const auto pairs = random_pairs(100);
  Opened source;
  ExportNotes notes;
  CHECK(test::faults_of([&] { node_values(source, pairs.wi, pairs.wo, 1, notes); }).find("cannot be evaluated") != std::string::npos);
  source.brdf = std::make_shared<const Ramp>(0.3);
  CHECK(test::faults_of([&] { node_values(source, pairs.wi, pairs.wo, 2, notes); }).find("an infinite value") != std::string::npos);
}
