// SPDX-License-Identifier: BSD-3-Clause
// The physics of a reading, one effect at a time.
#include "acquisition/simulated/optics.hpp"

#include <cmath>
#include <limits>

#include "acquisition/reduce.hpp"
#include "tests/acquisition/test_bench.hpp"
#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::acquisition;
using namespace gonio::acquisition::test;
using simulated::Exposure;
using simulated::Optics;

namespace {

Exposure lit(std::int64_t step = 1) {
  Exposure e;
  e.pose = {degrees(30), degrees(0), degrees(50), degrees(170)};
  e.shutter_open = true;
  e.exposure_s = 0.5;
  e.tag.step = step;
  return e;
}

/// Mean and variance of many readings that differ in nothing but their step.
std::pair<double, double> statistics(const Optics& optics, int n) {
  double mean = 0, squares = 0;
  for (int k = 1; k <= n; ++k) {
    const double delta = optics.signal_w(lit(k)) - mean;
    mean += delta / k;
    squares += delta * (optics.signal_w(lit(k)) - mean);
  }
  return {mean, squares / (n - 1)};
}

class Unknown final : public Brdf {
 public:
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {}; }
  void eval(std::span<const Direction>, std::span<const Direction>, std::span<double> f) const override {
    for (double& value : f) value = std::numeric_limits<double>::quiet_NaN();
  }

 private:
  Channels channels_ = single_channel("f");
};

}  // namespace

TEST_CASE("A reading is the mean of f over the stated apertures: a narrow peak comes out low") {
  const auto narrow = std::make_shared<AnalyticBrdf>("phong", single_channel("Y"), std::vector<std::vector<double>>{{0, .3, 1e4}});
  Exposure peak = lit();
  peak.pose = {degrees(30), degrees(0), degrees(30), degrees(180)};
  Bench bench = ideal_bench();
  const double point = Optics(bench, narrow).signal_w(peak) / peak.pose.theta_o.cos();
  bench.apertures.receiver_half_angle_deg = 0.5;
  const double mean = Optics(bench, narrow).signal_w(peak) / projected_solid_angle(peak.pose.theta_o, degrees(0.5));
  // The mean of exp(-s psi²/2) over a disc of radius a is (1 - exp(-x))/x with x = s a²/2.
  const double a = degrees(0.5).radians(), x = 1e4 * a * a / 2;
  CHECK(mean / point == Approx(-std::expm1(-x) / x).epsilon(1e-3));
  CHECK(mean < 0.84 * point);
}

TEST_CASE("Without effects a reading is flux times f times the projected solid angle") {
  Bench bench = ideal_bench();
  const Exposure e = lit();
  const double f = sample()->eval(e.pose).front();
  CHECK(Optics(bench, sample()).signal_w(e) == Approx(bench.source_power_w * f * e.pose.theta_o.cos()).epsilon(1e-15));
  const auto lambert = std::make_shared<AnalyticBrdf>("lambert", single_channel("Y"), std::vector<std::vector<double>>{{.5}});
  bench.apertures.receiver_half_angle_deg = 1;
  CHECK(Optics(bench, lambert).signal_w(e) ==
        Approx(bench.source_power_w * lambert->eval(e.pose).front() * projected_solid_angle(e.pose.theta_o, degrees(1))).epsilon(1e-14));
  Exposure white = e;
  white.white_in_beam = true;
  CHECK(Optics(ideal_bench(), sample()).signal_w(white) ==
        Approx(bench.source_power_w * bench.reference.f_per_sr * e.pose.theta_o.cos()).epsilon(1e-15));
  Exposure closed = e, behind = e;
  closed.shutter_open = false;
  behind.pose.theta_i = degrees(100);
  CHECK(Optics(bench, sample()).signal_w(closed) == 0);
  CHECK(Optics(bench, sample()).signal_w(behind) == 0);
}

TEST_CASE("Dark adds, drift scales with bench time, the certificate's error moves the white only") {
  const double ideal = Optics(ideal_bench(), sample()).signal_w(lit());
  Bench bench = ideal_bench();
  bench.simulated.dark = 1e-6;
  Exposure closed = lit();
  closed.shutter_open = false;
  CHECK(Optics(bench, sample()).signal_w(lit()) == Approx(ideal + 1e-6).epsilon(1e-15));
  CHECK(Optics(bench, sample()).signal_w(closed) == 1e-6);

  bench = ideal_bench();
  bench.simulated.drift_per_hour = 0.02;
  Exposure later = lit();
  later.middle = 1800 * second;
  CHECK(Optics(bench, sample()).signal_w(lit()) == ideal);
  CHECK(Optics(bench, sample()).signal_w(later) == Approx(1.01 * ideal).epsilon(1e-15));

  bench = ideal_bench();
  bench.simulated.certificate_error = true;
  bench.reference.u_relative = 0.005;
  Exposure white = lit();
  white.white_in_beam = true;
  const double certified = Optics(ideal_bench(), sample()).signal_w(white), true_white = Optics(bench, sample()).signal_w(white);
  CHECK(Optics(bench, sample()).signal_w(lit()) == ideal);
  CHECK(true_white != certified);
  CHECK(std::abs(true_white / certified - 1) < 5 * 0.005);
}

TEST_CASE("Shot noise has the variance S/(k t), read noise its own, and they add") {
  constexpr int n = 20'000;
  const double relative = 5 * std::sqrt(2.0 / n);  // five standard deviations of a variance
  const double ideal = Optics(ideal_bench(), sample()).signal_w(lit());
  Bench bench = ideal_bench();
  bench.simulated.shot_counts_per_unit = 1e9;
  const double shot = ideal / (1e9 * 0.5);
  auto [mean, variance] = statistics(Optics(bench, sample()), n);
  CHECK(std::abs(mean - ideal) < 5 * std::sqrt(shot / n));
  CHECK(variance == Approx(shot).epsilon(relative));
  bench.simulated.read_noise = 2 * std::sqrt(shot);
  std::tie(mean, variance) = statistics(Optics(bench, sample()), n);
  CHECK(variance == Approx(5 * shot).epsilon(relative));
}

TEST_CASE("Noise depends on the tag and the seed, not on the time") {
  Bench bench = ideal_bench();
  bench.simulated.read_noise = 1e-6;
  const Optics optics(bench, sample());
  bench.seed += 1;
  const Optics other(bench, sample());
  Exposure later = lit(), repeat = lit(), attempt = lit();
  later.middle = 1000 * second;
  repeat.tag.repeat = 1;
  attempt.tag.attempt = 1;
  const double value = optics.signal_w(lit());
  CHECK(optics.signal_w(later) == value);
  CHECK(optics.signal_w(repeat) != value);
  CHECK(optics.signal_w(attempt) != value);
  CHECK(optics.signal_w(lit(2)) != value);
  CHECK(other.signal_w(lit()) != value);
}

TEST_CASE("Where nothing is known of the sample there is no reading") {
  CHECK(std::isnan(Optics(ideal_bench(), std::make_shared<Unknown>()).signal_w(lit())));
  EmbeddedBench b(ideal_bench(), std::make_shared<Unknown>());
  ConnectedBench devices = connect(b.bench, b.clock);
  devices.detector->configure(550, 1, 0.1);
  devices.source->open_shutter(true);
  CHECK_THROWS_AS(devices.detector->read(0.1), Error);
}
