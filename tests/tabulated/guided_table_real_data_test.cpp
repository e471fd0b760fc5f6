// SPDX-License-Identifier: BSD-3-Clause
// Tables made of the readings of a real gonio-reflectometer.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "tabulated/formats/csv.hpp"
#include "tabulated/guided_table.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/measured_model.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr double pi = std::numbers::pi;
const std::string folder = "loft_rt300s/raw_csv/";

/// EC1 less its blank, as it is read; without a quantity as raw ratios.
std::shared_ptr<Dataset> ec1(Quantity quantity) {
  const auto path = test::measured_data(folder + "ANOPLATE_AnoBlack_EC1_Alum6061_v1o0_20251115.csv");
  const auto blank = test::measured_data(folder + "blank_v2o0_20250911.csv");
  if (!path || !blank) return nullptr;
  ReadOptions options;
  options.columns = {{"phi_o_deg", "azimuth_deg"}, {"theta_i_deg", "incidence_deg"}, {"theta_o_deg", "receive_deg"}, {"value", "RT"}};
  options.set = {{"phi_i_deg", 90}};
  options.quantity = quantity;
  options.blank = *blank;
  return std::make_shared<Dataset>(read_csv(*path, options));
}

bool in_shadow(const GonioAngles& angles) { return dot(angles.wi(), angles.wo()) > degrees(3).cos(); }

GuidedTable table_of(std::shared_ptr<Dataset> data) {
  data->symmetry.isotropic = true;
  for (std::size_t k = 0; k < data->size(); ++k)
    if (in_shadow(data->angles[k])) data->f[0][k] = std::numeric_limits<double>::quiet_NaN();
  return GuidedTable(std::move(data),
                     std::make_shared<const AnalyticBrdf>(test::model("ggx-separable-fresnel", {0.0166, 0.963, 0.302, 1.471})));
}

}  // namespace

TEST_CASE("EC1 in plane: at the raw nodes outside the shadow the table is (raw - blank)/(pi cos receive)") {
  const auto raw = ec1(Quantity::f), f = ec1(Quantity::signal_ratio);
  SUCCEED();
  if (!raw) return;
  const GuidedTable table = table_of(f);
  // Azimuth -90 with receive +theta and azimuth +90 with receive -theta are the same direction, read twice.
  std::map<std::array<double, 3>, std::pair<double, int>> readings;
  for (std::size_t k = 0; k < raw->size(); ++k) {
    const GonioAngles& a = raw->angles[k];
    if (std::fabs(a.wo().x()) > 1e-12 || a.theta_o.degrees() == 0 || in_shadow(a)) continue;
    auto& [sum, n] = readings[{a.theta_i.degrees(), a.theta_o.degrees(), a.wo().y() > 0 ? 90.0 : -90.0}];
    sum += raw->f[0][k] / (pi * a.theta_o.cos()), ++n;
  }
  CHECK(readings.size() > 100);
  double worst = 0;
  for (const auto& [at, reading] : readings) {
    const Direction wi = Direction::spherical(degrees(at[0]), 90_deg), wo = Direction::spherical(degrees(at[1]), degrees(at[2]));
    worst = std::max(worst, std::fabs(table.eval(wi, wo)[0] - reading.first / reading.second));
  }
  CHECK(worst < 1e-6);
}

TEST_CASE("EC1: the integral of f cos theta_o to 80 degrees is the published one") {
  const auto f = ec1(Quantity::signal_ratio);
  SUCCEED();
  if (!f) return;
  const GuidedTable table = table_of(f);
  for (const auto& [incidence, published] : std::map<double, double>{{10, 0.0508}, {30, 0.0518}, {50, 0.0556}, {70, 0.0850}}) {
    const Direction wi = Direction::spherical(degrees(incidence), 90_deg);
    double sum = 0;
    constexpr int zeniths = 80, azimuths = 180;
    for (int t = 0; t < zeniths; ++t)
      for (int p = 0; p < azimuths; ++p) {
        const Angle theta = degrees(t + 0.5);
        sum +=
            table.eval(wi, Direction::spherical(theta, degrees(2.0 * p)))[0] * theta.cos() * theta.sin() * (pi / 180) * 2 * pi / azimuths;
      }
    INFO(fmt::format("incidence {}: {:.4f}", incidence, sum));
    CHECK(sum == Approx(published).epsilon(0.03));
  }
}
