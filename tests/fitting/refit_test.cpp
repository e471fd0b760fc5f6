// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/refit.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/analytic_brdf.hpp"
#include "brdf/error.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr double pi = std::numbers::pi;

/// a/π + b cos^s θh, a and b per channel: small enough to know everything about it.
EvaluateFormula prepare(const ChannelValues& values) {
  return [values](const Direction& wi, const Direction& wo, double* f) {
    const LobeGeometry g = lobe_geometry(wi, wo);
    for (std::size_t c = 0; c < values.size(); ++c)
      f[c] = g.above_horizon() ? values[c][0] / pi + values[c][1] * cosine_power(g.log_cos_h, values[c][2]) : 0;
  };
}

TargetFormula formula() {
  return {"toy",
          "none",
          "s",
          "none",
          "none",
          {{"a", 0, 1, true}, {"b", 0, 5, true}, {"s", 1, 1000, false}},
          prepare,
          [](const LobeSummary& s) {
            ChannelValues values;
            for (std::size_t c = 0; c < s.rho_d.size(); ++c) values.push_back({s.rho_d[c], s.f0[c], 2 / (s.alpha_x * s.alpha_x)});
            return std::vector<ChannelValues>{values};
          },
          {}};
}

AnalyticBrdf source(double s = 60) { return {"blinn-phong", rgb_channels(), {{0.3, 0.2, s}, {0.2, 0.2, s}, {0.1, 0.05, s}}}; }

LobeSummary far_off() { return {{0.5, 0.5, 0.5}, {0.1, 0.1, 0.1}, {1, 1, 1}, 0.4, 0.4}; }

}  // namespace

TEST_CASE("a refit finds the parameters of a source it can express") {
  const fitting::RefitData data = fitting::refit_data(source());
  const fitting::Refit found = fitting::refit(data, formula(), far_off());
  const double b = 68 / (8 * pi);
  CHECK(found.values[0][0] == Approx(0.3).epsilon(1e-6));
  CHECK(found.values[1][1] == Approx(0.2 * b).epsilon(1e-6));
  CHECK(found.values[2][1] == Approx(0.05 * b).epsilon(1e-6));
  CHECK(found.values[0][2] == Approx(60).epsilon(1e-6));
  CHECK(found.errors.log_rms < 1e-7);
  CHECK(found.naive_errors.log_rms > 0.1);
  REQUIRE(found.errors.albedo_difference);
  CHECK(std::abs(*found.errors.albedo_difference) < 1e-6);
  CHECK(found.at_bound.empty());
}

TEST_CASE("a parameter the target cannot reach ends at its bound, and the error says so") {
  const fitting::Refit found = fitting::refit(fitting::refit_data(source(5000)), formula(), far_off());
  CHECK(found.values[0][2] == Approx(1000).epsilon(1e-6));
  REQUIRE(found.at_bound.size() >= 1);
  CHECK(found.at_bound.back() == 2);
  CHECK(found.errors.log_rms > 0.01);
  CHECK(found.errors.misfit <= found.naive_errors.misfit);
  CHECK(found.errors.misfit >= found.errors.log_rms);
}

TEST_CASE("errors are those of a known difference") {
  const fitting::RefitData data = fitting::refit_data(AnalyticBrdf("lambert", single_channel("value"), {{0.5}}));
  const fitting::RefitErrors errors = fitting::refit_errors(data, [](const Direction&, const Direction&, double* f) { *f = 0.55 / pi; });
  CHECK(errors.mean_relative == Approx(0.1).epsilon(0.03));  // of the floor under what is dark
  CHECK(errors.mean_relative < 0.1);
  REQUIRE(errors.albedo_difference);
  CHECK(*errors.albedo_difference == Approx(0.05).epsilon(1e-2));  // of the quadrature over half vectors
  double sum = 0;
  for (const double w : data.weight) sum += w;
  // ∫∫ cos cos dωi dωo up to 80° each.
  const double cap = pi * std::pow(std::sin(80 * pi / 180), 2);
  CHECK(sum == Approx(cap * cap).epsilon(0.05));
}

TEST_CASE("a refit of samples goes through the samples alone") {
  Dataset samples;
  samples.channels = single_channel("value");
  const AnalyticBrdf brdf("blinn-phong", samples.channels, {{0.3, 0.2, 60}});
  samples.f.resize(1);
  for (int i = 0; i < 80; i += 10)
    for (int o = -80; o <= 80; o += 4) {
      samples.angles.push_back({degrees(i), 0_deg, degrees(std::abs(o)), degrees(o < 0 ? 0 : 180)});
      samples.f[0].push_back(o == 40 ? std::numeric_limits<double>::quiet_NaN() : brdf.eval(samples.angles.back())[0]);
    }
  const fitting::RefitData data = fitting::refit_data(brdf, &samples);
  CHECK(data.at_samples);
  CHECK(data.size() == samples.size() - 8);
  // Light from one azimuth only: nothing is known of anisotropy.
  CHECK(data.isotropic);
  const fitting::Refit found = fitting::refit(data, formula(), {{0.5}, {0.1}, {1}, 0.4, 0.4});
  CHECK(found.values[0][2] == Approx(60).epsilon(1e-6));
  CHECK(found.errors.log_rms < 1e-7);
}

TEST_CASE("a black source is refused") {
  CHECK_THROWS_AS(fitting::refit_data(AnalyticBrdf("lambert", single_channel("value"), {{0.0}})), Error);
}

TEST_CASE("a source that knows nothing is refused") {
  class Unknown final : public Brdf {
   public:
    const Channels& channels() const override { return channels_; }
    Symmetry symmetry() const override { return {}; }
    void eval(std::span<const Direction>, std::span<const Direction>, std::span<double> f) const override {
      std::fill(f.begin(), f.end(), std::numeric_limits<double>::quiet_NaN());
    }

   private:
    Channels channels_ = single_channel("value");
  };
  CHECK_THROWS_AS(fitting::refit_data(Unknown{}), Error);
}
