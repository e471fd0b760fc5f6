// SPDX-License-Identifier: BSD-3-Clause
// Every check: a wrong case fails, a right one is seldom refused, and data that cannot tell are said to be so.
#include "fitting/checks/checks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "fitting/distributions.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// Every direction pair of a grid and its exchange.
std::vector<GonioAngles> pairs_of_directions() {
  std::vector<GonioAngles> directions, out;
  for (const double theta : {10., 25., 40., 55., 70.})
    for (double phi = 0; phi < 360; phi += 60) directions.push_back({degrees(theta), degrees(phi), {}, {}});
  for (const GonioAngles& i : directions)
    for (const GonioAngles& o : directions) out.push_back({i.theta_i, i.phi_i, o.theta_i, o.phi_i});
  return out;
}

/// The same poses relative to the plane of incidence at several azimuths of the sample.
std::vector<GonioAngles> turned_poses() {
  std::vector<GonioAngles> out;
  for (double turn = 0; turn < 360; turn += 30)
    for (const double theta_i : {20., 45., 70.})
      for (const double theta_o : {15., 50.})
        for (const double delta : {0., 60., 140., 180.})
          out.push_back({degrees(theta_i), degrees(turn), degrees(theta_o), degrees(turn + delta)});
  return out;
}

using Distortion = std::function<double(const GonioAngles&)>;

std::shared_ptr<Dataset> sweep(const std::vector<GonioAngles>& angles, const Noise& noise, unsigned seed, const Distortion& factor = {}) {
  const AnalyticBrdf truth = lobe("blinn-phong", .3, .2, 10);
  auto data = readings(truth, angles, noise, seed);
  if (factor)
    for (std::size_t k = 0; k < angles.size(); ++k) data->f[0][k] += truth.eval(angles[k])[0] * (factor(angles[k]) - 1);
  return data;
}

Check run(Check (*check)(const CheckSubject&, const CheckOptions&), std::shared_ptr<const Dataset> data) {
  return check({{std::move(data)}, nullptr, nullptr}, {});
}

constexpr int seeds = 300;
/// Of 300 correct data sets at a significance of 1 % more than 9 are refused with a probability below 0.2 %.
constexpr int most_refused = 9;
const Noise percent{0, 0, 0.01};

int refused(Check (*check)(const CheckSubject&, const CheckOptions&), const std::vector<GonioAngles>& angles, const Noise& noise) {
  int count = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Check result = run(check, sweep(angles, noise, seed));
    count += result.p_value && *result.p_value < 0.01;
  }
  return count;
}

}  // namespace

TEST_CASE("the list holds the four checks by id") {
  std::vector<std::string> ids;
  for (const CheckEntry& entry : check_list()) {
    ids.emplace_back(entry.id);
    CHECK(entry.run({}, {}).id == entry.id);
    CHECK(entry.run({}, {}).verdict == Verdict::vacuous);
  }
  CHECK(ids == std::vector<std::string>{"reciprocity", "isotropy", "energy", "positivity"});
}

TEST_CASE("reciprocity: reciprocal data pass and are seldom refused") {
  const Check check = run(check_reciprocity, sweep(pairs_of_directions(), percent, 5));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::pass);
  CHECK(check.n == 435);
  CHECK(refused(check_reciprocity, pairs_of_directions(), percent) <= most_refused);
}
TEST_CASE("reciprocity: an asymmetry of 5 % fails, one of 1 % warns, and the effect is its size") {
  const auto skew = [](double size) { return [size](const GonioAngles& a) { return 1 + size * (a.theta_i.cos() - a.theta_o.cos()); }; };
  const Check large = run(check_reciprocity, sweep(pairs_of_directions(), percent, 5, skew(.2)));
  INFO(large.detail);
  CHECK(large.verdict == Verdict::fail);
  CHECK(large.detail.find("cosines") != std::string::npos);
  // f differs by 2 · 0.2 · (cos i - cos o); rms over the pairs.
  double square = 0, count = 0;
  for (const GonioAngles& a : pairs_of_directions()) square += std::pow(.4 * (a.theta_i.cos() - a.theta_o.cos()), 2), count += 1;
  CHECK(*large.effect == Approx(std::sqrt(square / count)).epsilon(0.15));
  const Check small = run(check_reciprocity, sweep(pairs_of_directions(), percent, 5, skew(.015)));
  INFO(small.detail);
  CHECK(small.verdict == Verdict::warn);
}
TEST_CASE("reciprocity: a common scale is no asymmetry") {
  auto data = sweep(pairs_of_directions(), percent, 6);
  for (double& f : data->f[0]) f *= 1.3;
  data->correlated.push_back({"scale", 0.05, {}});
  CHECK(run(check_reciprocity, data).verdict == Verdict::pass);
}
TEST_CASE("reciprocity: a known tilt is no asymmetry, an unknown one is") {
  std::vector<double> sensitivity;
  const auto angles = pairs_of_directions();
  for (const GonioAngles& a : angles) sensitivity.push_back(a.wi().x() - a.wo().x());
  auto data = sweep(angles, percent, 6, [](const GonioAngles& a) { return 1 + .04 * (a.wi().x() - a.wo().x()); });
  CHECK(run(check_reciprocity, data).verdict == Verdict::fail);
  data->correlated.push_back({"tilt", 0.04, sensitivity});
  CHECK(run(check_reciprocity, data).verdict == Verdict::pass);
}
TEST_CASE("reciprocity is vacuous by construction, without partners, without u and with too much noise") {
  auto flagged = sweep(pairs_of_directions(), percent, 1);
  flagged->symmetry.reciprocal = true;
  CHECK(run(check_reciprocity, flagged).verdict == Verdict::vacuous);
  const Check alone = run(check_reciprocity, sweep(polar_grid({33}, 10, 45), percent, 1));
  CHECK(alone.verdict == Verdict::vacuous);
  CHECK(alone.detail.find("partner") != std::string::npos);
  auto bare = sweep(pairs_of_directions(), percent, 1, [](const GonioAngles& a) { return 1 + .2 * (a.theta_i.cos() - a.theta_o.cos()); });
  bare->u.clear();
  const Check unknown = run(check_reciprocity, bare);
  CHECK(unknown.verdict == Verdict::vacuous);
  CHECK(unknown.effect.value_or(0) > 0.05);
  CHECK(!unknown.p_value);
  const Check blurred = run(check_reciprocity, sweep(pairs_of_directions(), {0, 0, 0.5}, 1));
  INFO(blurred.detail);
  CHECK(blurred.verdict == Verdict::vacuous);
}

TEST_CASE("isotropy: isotropic data pass and are seldom refused") {
  const Check check = run(check_isotropy, sweep(turned_poses(), percent, 5));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::pass);
  CHECK(check.n == 24);
  CHECK(refused(check_isotropy, turned_poses(), percent) <= most_refused);
}
TEST_CASE("isotropy: an anisotropic sample fails and a tilt is told from it") {
  const auto brushed = [](const GonioAngles& a) { return 1 + .06 * std::cos(2 * a.phi_i.radians()); };
  const Check check = run(check_isotropy, sweep(turned_poses(), percent, 5, brushed));
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  CHECK(*check.effect == Approx(.06 / std::numbers::sqrt2).epsilon(0.15));
  CHECK(check.detail.find("twice per turn") != std::string::npos);
  const Check tilt = run(check_isotropy, sweep(turned_poses(), percent, 5, [](const GonioAngles& a) { return 1 + .06 * a.phi_i.sin(); }));
  CHECK(tilt.detail.find("once per turn") != std::string::npos);
}
TEST_CASE("isotropy: data sets of the rotated sample are compared pose by pose") {
  CheckSubject same, turned;
  CheckOptions options;
  for (unsigned k = 0; k < 4; ++k) {
    const double rotation = 30.0 * k;
    options.rotation_deg.push_back(rotation);
    same.datasets.push_back(sweep(polar_grid({20, 50}, 20, 45), percent, 10 + k));
    turned.datasets.push_back(sweep(polar_grid({20, 50}, 20, 45), percent, 10 + k,
                                    [&](const GonioAngles&) { return 1 + .1 * std::cos(2 * rotation * std::numbers::pi / 180); }));
  }
  CHECK(check_isotropy(same, options).verdict == Verdict::pass);
  CHECK(check_isotropy(turned, options).verdict == Verdict::fail);
}
TEST_CASE("isotropy is vacuous at one azimuth of the sample, by construction and without u; mirror pairs do not count") {
  const Check one = run(check_isotropy, sweep(polar_grid({20, 50}, 20, 45), percent, 1));
  CHECK(one.verdict == Verdict::vacuous);
  CHECK(one.n == 0);
  auto flagged = sweep(turned_poses(), percent, 1);
  flagged->symmetry.isotropic = true;
  CHECK(run(check_isotropy, flagged).verdict == Verdict::vacuous);
  auto bare = sweep(turned_poses(), percent, 1);
  bare->u.clear();
  CHECK(run(check_isotropy, bare).verdict == Verdict::vacuous);
}

TEST_CASE("energy: the customary Blinn-Phong normalisation reflects more than it receives") {
  const CheckSubject subject{{}, nullptr, std::make_shared<AnalyticBrdf>(lobe("blinn-phong", .05, .93, 8.764))};
  const Check check = check_energy(subject, {});
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  CHECK(*check.effect == Approx(1.0499).margin(5e-5));
  CHECK(check.detail.find("1.0499") != std::string::npos);
  const CheckSubject exact{{}, nullptr, std::make_shared<AnalyticBrdf>(lobe("blinn-phong-exact", .05, .93, 8.764))};
  CHECK(check_energy(exact, {}).verdict == Verdict::pass);
}
TEST_CASE("energy: scattered samples of a bright surface fail, of a modest one pass, seldom refused at exactly one") {
  const auto albedo_of = [](double rho_d, unsigned seed) {
    return run(check_energy,
               readings(AnalyticBrdf("lambert", single_channel("Y"), {{rho_d}}), polar_grid({20, 60}, 10, 15), percent, seed));
  };
  const Check bright = albedo_of(1.05, 1), modest = albedo_of(.6, 2);
  INFO(bright.detail << " / " << modest.detail);
  CHECK(bright.verdict == Verdict::fail);
  CHECK(*bright.effect == Approx(1.05).epsilon(0.01));
  CHECK(modest.verdict == Verdict::pass);
  CHECK(*modest.effect == Approx(.6).epsilon(0.01));
  int refused_at_one = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) refused_at_one += *albedo_of(1, seed).p_value < 0.01;
  CHECK(refused_at_one <= 3);
}
TEST_CASE("energy: a node on an unresolved peak is no proof, and one plane of samples is vacuous") {
  // s = 5000 on a 10° grid: the nearest-sample rule would put the albedo far above one.
  const Check sharp = run(check_energy, readings(lobe("blinn-phong", .1, .5, 5000), polar_grid({20}, 10, 15), percent, 1));
  INFO(sharp.detail);
  CHECK(sharp.verdict == Verdict::vacuous);
  std::vector<GonioAngles> plane;
  for (double theta = 0; theta <= 80; theta += 5)
    for (const double phi : {0., 180.}) plane.push_back({degrees(30), degrees(0), degrees(theta), degrees(phi)});
  const Check line = run(check_energy, readings(lobe("blinn-phong", .1, .5, 10), plane, percent, 1));
  INFO(line.detail);
  CHECK(line.verdict == Verdict::vacuous);
  CHECK(run(check_energy, readings(lobe("blinn-phong", .1, .5, 10), polar_grid({20}, 40, 90), percent, 1)).verdict == Verdict::vacuous);
}
TEST_CASE("energy: a function without a closed form is integrated") {
  struct Wrapped final : Brdf {
    AnalyticBrdf inner = lobe("blinn-phong", .05, .93, 8.764);
    const Channels& channels() const override { return inner.channels(); }
    Symmetry symmetry() const override { return inner.symmetry(); }
    void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override { inner.eval(wi, wo, f); }
  };
  const Check check = check_energy({{}, nullptr, std::make_shared<Wrapped>()}, {});
  INFO(check.detail);
  CHECK(check.verdict == Verdict::fail);
  CHECK(*check.effect == Approx(1.0499).margin(5e-4));
}

TEST_CASE("positivity: noise about zero passes, negative values fail, a single impossible one warns") {
  auto black = [](unsigned seed) {
    return readings(AnalyticBrdf("lambert", single_channel("Y"), {{0.0}}), pairs_of_directions(), {1e-3, 0, 0}, seed);
  };
  const Check noise = run(check_positivity, black(3));
  INFO(noise.detail);
  CHECK(noise.verdict == Verdict::pass);
  int refused_noise = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) refused_noise += *run(check_positivity, black(seed)).p_value < 0.01;
  CHECK(refused_noise <= most_refused);
  auto shifted = black(3);
  for (std::size_t k = 0; k < shifted->f[0].size(); k += 10) shifted->f[0][k] -= 0.02;
  CHECK(run(check_positivity, shifted).verdict == Verdict::fail);
  auto single = black(3);
  single->f[0][17] = -0.05;
  CHECK(run(check_positivity, single).verdict == Verdict::warn);
}
TEST_CASE("positivity: negatives of unknown uncertainty are counted but not judged") {
  auto data = sweep(pairs_of_directions(), percent, 1);
  data->u.clear();
  CHECK(run(check_positivity, data).verdict == Verdict::pass);
  data->f[0][3] = -1;
  const Check check = run(check_positivity, data);
  CHECK(check.verdict == Verdict::vacuous);
  CHECK(*check.effect == Approx(1.0 / static_cast<double>(data->size())));
}

TEST_CASE("Holm: a p-value that is small alone need not be small among all checks") {
  CheckSubject subject{{sweep(pairs_of_directions(), percent, 5)}, nullptr, nullptr};
  int alone = 0, together = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    subject.datasets = {sweep(pairs_of_directions(), percent, seed)};
    alone += *check_reciprocity(subject, {}).p_value < 0.01;
    for (const Check& check : run_checks(subject, {}))
      if (check.id == "reciprocity") together += check.verdict == Verdict::fail || check.verdict == Verdict::warn;
    if (seed == 60 && alone == 0) break;
  }
  CHECK(together <= alone);
}

TEST_CASE("judge: significant and large fails, significant warns, equivalent passes, anything else cannot tell") {
  CHECK(judge(true, .05, .06, .02) == Verdict::fail);
  CHECK(judge(true, .01, .015, .02) == Verdict::warn);
  CHECK(judge(false, .005, .015, .02) == Verdict::pass);
  CHECK(judge(false, .005, .03, .02) == Verdict::vacuous);
}

TEST_CASE("distributions agree with tabulated values") {
  CHECK(normal_upper_tail(1.959963984540054) == Approx(0.025).epsilon(1e-12));
  CHECK(normal_upper_quantile(0.025) == Approx(1.959963984540054).epsilon(1e-12));
  CHECK(normal_upper_tail(10) == Approx(7.61985302416e-24).epsilon(1e-10));
  CHECK(chi2_upper_tail(3.841458820694124, 1) == Approx(0.05).epsilon(1e-11));
  CHECK(chi2_upper_tail(124.34211340400407, 100) == Approx(0.05).epsilon(1e-10));
  CHECK(chi2_upper_tail(0, 5) == 1);
  CHECK(student_two_sided_quantile(0.95, 1) == Approx(12.706204736174694).epsilon(1e-9));
  CHECK(student_two_sided_quantile(0.95, 10) == Approx(2.2281388519649385).epsilon(1e-9));
  CHECK(student_two_sided_quantile(0.95, 1e6) == Approx(1.95996635682).epsilon(1e-7));
  CHECK(binomial_upper_tail(3, 10, 0.1) == Approx(0.0701908264).epsilon(1e-8));
  CHECK(binomial_upper_tail(1, 10, 0.5) == Approx(1 - std::pow(.5, 10)).epsilon(1e-12));
  CHECK(binomial_upper_limit(0, 100, 0.01) == Approx(1 - std::pow(.01, .01)).epsilon(1e-9));
}
