// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/rgl_table.hpp"

#include <cmath>
#include <numbers>

#include "tabulated/formats/rgl.hpp"
#include "tests/tabulated/tensor_writer.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

constexpr double pi = std::numbers::pi;
/// Axes and values of the file are floats.
constexpr double float_rounding = 1e-6;

RglTable table_of(const test::RglMaterial& material) {
  const test::TemporaryFolder folder;
  return RglTable(read_rgl(folder.file("m.bsdf", test::tensor_file(material.fields()))));
}

Direction at(double theta_deg, double phi_deg) { return Direction::spherical(degrees(theta_deg), degrees(phi_deg)); }

}  // namespace

TEST_CASE("A table of values that follow the half vector gives them over cos theta_o") {
  // S = 1 + x + 2y over the warped square; visible density x makes x the square of u.x, which is 2 theta_m / pi.
  const RglTable table =
      table_of({.value = [](std::size_t, std::size_t c, double x, double y) { return (1.0 + double(c)) * (1 + x + 2 * y); },
                .visible = [](double x, double) { return x; }});
  const Direction wi = at(35, 20), wo = at(60, 150);
  const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z();
  const double theta_m = std::atan2(std::hypot(hx, hy), hz), phi_m = std::atan2(hy, hx) - 20 * pi / 180;
  const double s = 1 + theta_m * 2 / pi + 2 * (phi_m + pi) / (2 * pi);
  const auto f = table.eval(wi, wo);
  REQUIRE(f.size() == 3);
  for (std::size_t c = 0; c < 3; ++c) CHECK(std::fabs(f[c] * wo.z() / ((1.0 + double(c)) * s) - 1) < float_rounding);
  CHECK(table.symmetry().isotropic);
  CHECK_FALSE(table.symmetry().reciprocal);
}

TEST_CASE("An isotropic table depends on the difference of the azimuths only, and is 0 below the horizon") {
  const RglTable table = table_of({.value = [](std::size_t, std::size_t, double x, double y) { return 1 + x * y; }});
  const double f = table.eval(at(30, 10), at(50, 100))[0];
  for (const double turn : {33.0, 170.0, -120.0})
    CHECK(std::fabs(table.eval(at(30, 10 + turn), at(50, 100 + turn))[0] / f - 1) < float_rounding);
  CHECK(table.eval(at(30, 10), at(95, 100))[0] == 0);
  CHECK(table.eval(at(95, 10), at(50, 100))[0] == 0);
}

TEST_CASE("Slices are mixed linearly in theta_i and hold beyond the last one") {
  const RglTable table =
      table_of({.theta_i = {0, 0.5f, 1.0f}, .value = [](std::size_t slice, std::size_t, double, double) { return double(slice); }});
  const auto slice_at = [&](double theta) {
    const Direction wi = Direction::spherical(radians(theta), 0_deg);
    return table.eval(wi, at(0, 0))[0];
  };
  CHECK(std::fabs(slice_at(0.25) - 0.5) < float_rounding);
  CHECK(std::fabs(slice_at(0.9) - 1.8) < float_rounding);
  CHECK(std::fabs(slice_at(1.3) - 2) < float_rounding);
}

TEST_CASE("Half a turn of incidences is completed by rotation, a quarter by mirror images") {
  const auto value = [](std::size_t slice, std::size_t, double x, double y) { return 1 + double(slice) + x + 3 * y; };
  const float p = static_cast<float>(pi);
  const RglTable half = table_of({.phi_i = {-p, -p / 2, 0}, .theta_i = {0.6f}, .value = value});
  CHECK_FALSE(half.symmetry().isotropic);
  CHECK(std::fabs(half.eval(at(40, 50), at(60, 90))[0] / half.eval(at(40, 230), at(60, 270))[0] - 1) < float_rounding);
  CHECK(std::fabs(half.eval(at(40, 50), at(60, 90))[0] / half.eval(at(40, 90), at(60, 130))[0] - 1) > 0.01);
  const RglTable quarter = table_of({.phi_i = {-p, -0.75f * p, -p / 2}, .theta_i = {0.6f}, .value = value});
  const double f = quarter.eval(at(40, -130), at(60, -100))[0];
  CHECK(std::fabs(quarter.eval(at(40, 130), at(60, 100))[0] / f - 1) < float_rounding);
  CHECK(std::fabs(quarter.eval(at(40, -50), at(60, -80))[0] / f - 1) < float_rounding);
  CHECK(std::fabs(quarter.eval(at(40, 50), at(60, 80))[0] / f - 1) < float_rounding);
  CHECK(RglTable::turns({-p, 0, p}) == 1);
  CHECK(RglTable::turns({0, 0.3f, 0.7f}) == 0);
}

TEST_CASE("The samples of a table are its values at its nodes; nodes that hold nothing are counted") {
  const RglTable table =
      table_of({.value = [](std::size_t, std::size_t c, double x, double y) { return x == 1 ? 0 : (1 + double(c)) * (1 + y); }});
  const Dataset samples = table.samples();
  samples.require_consistent();
  REQUIRE(samples.size() > 6);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto f = table.eval(samples.angles[k].wi(), samples.angles[k].wo());
    // Where the half vector is the normal its azimuth is the table's alone.
    if (half_difference(samples.angles[k]).theta_h.radians() < 1e-6) continue;
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::fabs(samples.f[c][k] / f[c] - 1) < 1e-5);
  }
  CHECK(samples.size() + samples.masked.total() == 3 * 9);
  CHECK(samples.masked.below_horizon >= 9);  // the slice at grazing incidence
}
