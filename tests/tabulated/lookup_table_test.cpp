// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/lookup_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "brdf/analytic_brdf.hpp"
#include "brdf/coordinates.hpp"
#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

struct Columns {
  std::array<std::vector<float>, 3> xyz;
  void add(const Direction& w) {
    xyz[0].push_back(static_cast<float>(w.x())), xyz[1].push_back(static_cast<float>(w.y())), xyz[2].push_back(static_cast<float>(w.z()));
  }
  DirectionColumns view() const { return {{xyz[0], xyz[1], xyz[2]}}; }
  std::array<float, 3> at(std::size_t k) const { return {xyz[0][k], xyz[1][k], xyz[2][k]}; }
};

struct Pairs {
  std::vector<Direction> wi, wo;
  Columns i, o;
};

/// Pairs up to `most_deg` from the normal, the light's azimuth 0 or any.
Pairs random_pairs(std::size_t n, double most_deg, bool any_azimuth = true) {
  test::Random random(test::seed);
  Pairs out;
  for (std::size_t k = 0; k < n; ++k) {
    const auto draw = [&](bool turned) {
      return Direction::spherical(degrees(test::uniform(random, 0, most_deg)), degrees(turned ? test::uniform(random, -180, 180) : 0));
    };
    out.wi.push_back(draw(any_azimuth)), out.wo.push_back(draw(true));
    out.i.add(out.wi.back()), out.o.add(out.wo.back());
  }
  return out;
}

AnalyticBrdf glossy(Channels channels) {
  std::vector<std::vector<double>> parameters;
  for (std::size_t c = 0; c < channels.size(); ++c) parameters.push_back({0.1 + 0.1 * static_cast<double>(c), 0.3, 20});
  return {"blinn-phong", std::move(channels), std::move(parameters)};
}

double mean_error(const LookupTable& table, const Brdf& truth, const Pairs& pairs, Interpolation interpolation) {
  const std::size_t channels = truth.channels().size();
  std::vector<float> f(pairs.wi.size() * channels);
  table.eval(pairs.i.view(), pairs.o.view(), interpolation, f);
  std::vector<double> wanted(f.size());
  truth.eval(pairs.wi, pairs.wo, wanted);
  double sum = 0;
  for (std::size_t k = 0; k < f.size(); ++k) sum += std::fabs(static_cast<double>(f[k]) / wanted[k] - 1);
  return sum / static_cast<double>(f.size());
}

}  // namespace

TEST_CASE("A batch of directions gives the bits of one after the other") {
  const AnalyticBrdf brdf = glossy(rgb_channels());
  const Pairs pairs = random_pairs(4000, 95);  // some below the horizon
  for (const Parameterisation parameterisation : {Parameterisation::half_difference, Parameterisation::spherical})
    for (const Storage storage : {Storage::f32, Storage::f16})
      for (const Interpolation interpolation : {Interpolation::nearest, Interpolation::linear}) {
        const LookupTable table(brdf, {parameterisation, {20, 16, 24}, NodeRule::centre, true}, storage, 2);
        std::vector<float> f(pairs.wi.size() * 3), one(3);
        table.eval(pairs.i.view(), pairs.o.view(), interpolation, f);
        std::size_t different = 0, dark = 0;
        for (std::size_t k = 0; k < pairs.wi.size(); ++k) {
          table.eval_one(pairs.i.at(k), pairs.o.at(k), interpolation, one);
          dark += one[0] == 0;
          for (std::size_t c = 0; c < 3; ++c)
            different += std::bit_cast<std::uint32_t>(f[3 * k + c]) == std::bit_cast<std::uint32_t>(one[c]) ||
                                 (std::isnan(one[c]) && std::isnan(f[3 * k + c]))
                             ? 0
                             : 1;
        }
        CHECK(different == 0);
        CHECK(dark > 200);
      }
}

TEST_CASE("Coordinates agree with those of double precision") {
  const LookupTable table(glossy(single_channel("value")), merl_layout(), Storage::f32, 2);
  const Pairs pairs = random_pairs(20000, 89);
  std::array<std::vector<float>, 3> at;
  for (auto& axis : at) axis.resize(pairs.wi.size());
  table.coordinates(pairs.i.view(), pairs.o.view(), {std::span(at[0]), std::span(at[1]), std::span(at[2])});
  double worst[3] = {};
  for (std::size_t k = 0; k < pairs.wi.size(); ++k) {
    const HalfDifference exact = half_difference(pairs.wi[k], pairs.wo[k]);
    const double h = 90 * std::sqrt(exact.theta_h.degrees() / 90), d = exact.theta_d.degrees(),
                 p = fold_phi_d(exact.phi_d.radians()) * 180 / 3.14159265358979323846;
    const double turn = std::fabs(static_cast<double>(at[2][k]) - p);
    worst[0] = std::max(worst[0], std::fabs(static_cast<double>(at[0][k]) - h) * h);  // the root spreads the rounding near 0
    worst[1] = std::max(worst[1], std::fabs(static_cast<double>(at[1][k]) - d));
    // An azimuth about a short vector is as uncertain as that is short.
    worst[2] = std::max(worst[2], std::min(turn, 180 - turn) * exact.theta_d.sin() * exact.theta_h.sin());
  }
  // A few roundings of a unit vector, 6e-8 rad = 3.4e-6 degrees each; of theta_h by 45 (the root), and more where wi + wo nearly vanishes.
  CHECK(worst[0] < 3e-3);
  CHECK(worst[1] < 3e-5);
  CHECK(worst[2] < 5e-5);
}

TEST_CASE("A finer grid is nearer to its source, and interpolation nearer than the nearest node") {
  const AnalyticBrdf brdf = glossy(single_channel("value"));
  const Pairs pairs = random_pairs(20000, 80, false);
  for (const Parameterisation parameterisation : {Parameterisation::half_difference, Parameterisation::spherical}) {
    const auto error = [&](std::size_t scale, Interpolation interpolation) {
      const LookupTable table(brdf, {parameterisation, {scale, scale, 2 * scale}, NodeRule::ends, true}, Storage::f32, 2);
      return mean_error(table, brdf, pairs, interpolation);
    };
    const double coarse = error(12, Interpolation::linear), fine = error(48, Interpolation::linear),
                 nearest = error(48, Interpolation::nearest);
    CHECK(fine < coarse / 8);  // second order: 16 times, less near the horizon
    CHECK(fine < nearest / 3);
    CHECK(fine < 0.004);
  }
}

TEST_CASE("Half numbers cost no more than their rounding") {
  const AnalyticBrdf brdf("lambert", single_channel("value"), {{0.37}});
  const Pairs pairs = random_pairs(2000, 85);
  const LookupTable single(brdf, merl_layout(), Storage::f32, 2), half(brdf, merl_layout(), Storage::f16, 2);
  CHECK(mean_error(single, brdf, pairs, Interpolation::linear) < 2e-7);
  CHECK(mean_error(half, brdf, pairs, Interpolation::linear) < 4.9e-4);
  CHECK(mean_error(half, brdf, pairs, Interpolation::linear) > 1e-6);
  CHECK(2 * half.grid().bytes() == single.grid().bytes());
}
