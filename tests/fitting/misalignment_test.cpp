// SPDX-License-Identifier: BSD-3-Clause
// A misaligned sample shows the geometry of a turned one.
#include "fitting/misalignment.hpp"

#include <cmath>
#include <numbers>

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {
constexpr double degree = std::numbers::pi / 180;
}

TEST_CASE("a sample that stands right has the geometry of its angles, bit for bit") {
  const GonioAngles angles{degrees(30), degrees(10), degrees(50), degrees(200)};
  const LobeGeometry a = fitting::lobe_geometry(angles, {}), b = gonio::lobe_geometry(angles);
  CHECK(a.log_cos_h == b.log_cos_h);
  CHECK(a.log_cos_psi == b.log_cos_psi);
}

TEST_CASE("a normal that leans towards x brings directions at azimuth 0 nearer and those at 180 away") {
  const GonioAngles in_plane{degrees(30), degrees(0), degrees(40), degrees(180)};
  const LobeGeometry seen = fitting::lobe_geometry(in_plane, {2 * degree, 0, 0});
  CHECK(seen.cos_i == Approx(std::cos(28 * degree)));
  CHECK(seen.cos_o == Approx(std::cos(42 * degree)));
  const LobeGeometry across = fitting::lobe_geometry({degrees(30), degrees(90), degrees(40), degrees(270)}, {0, 2 * degree, 0});
  CHECK(across.cos_i == Approx(std::cos(28 * degree)));
  CHECK(across.cos_o == Approx(std::cos(42 * degree)));
}

TEST_CASE("a tilt moves the mirror direction by twice its angle and keeps the angle between the directions") {
  const GonioAngles mirrored{degrees(30), degrees(0), degrees(30), degrees(180)};
  const LobeGeometry seen = fitting::lobe_geometry(mirrored, {.5 * degree, 0, 0});
  CHECK(std::acos(std::exp(seen.log_cos_psi)) == Approx(1 * degree).epsilon(1e-6));
  CHECK(std::acos(std::exp(seen.log_cos_h)) == Approx(.5 * degree).epsilon(1e-6));
  const GonioAngles anywhere{degrees(20), degrees(15), degrees(70), degrees(120)};
  CHECK(fitting::lobe_geometry(anywhere, {.01, -.02, 0}).log_cos_retro ==
        Approx(gonio::lobe_geometry(anywhere).log_cos_retro).epsilon(1e-12));
}

TEST_CASE("a surface that is turned shows both directions at smaller azimuths, and the same lobe") {
  const GonioAngles angles{degrees(30), degrees(20), degrees(40), degrees(170)};
  const GonioAngles seen = seen_by({0, 0, 10 * degree}, angles);
  CHECK(seen.phi_i.degrees() == Approx(10));
  CHECK(seen.phi_o.degrees() == Approx(160));
  const LobeGeometry turned = fitting::lobe_geometry(angles, {0, 0, 10 * degree}), nominal = gonio::lobe_geometry(angles);
  CHECK(turned.log_cos_psi == Approx(nominal.log_cos_psi).epsilon(1e-12));
  CHECK(turned.slope_x != Approx(nominal.slope_x).epsilon(1e-3));
}

TEST_CASE("angles seen by a misaligned sample have the geometry of the misalignment") {
  const GonioAngles angles{degrees(30), degrees(20), degrees(40), degrees(170)};
  const Misalignment m{.02, -.01, .3};
  const LobeGeometry a = fitting::lobe_geometry(angles, m), b = gonio::lobe_geometry(seen_by(m, angles));
  CHECK(a.slope_x == Approx(b.slope_x).epsilon(1e-12));
  CHECK(a.slope_y == Approx(b.slope_y).epsilon(1e-12));
  CHECK(a.log_cos_psi == Approx(b.log_cos_psi).epsilon(1e-12));
}

TEST_CASE("a direction that sinks below the true horizon is taken at it") {
  const GonioAngles grazing{degrees(20), degrees(0), degrees(89), degrees(180)};
  const LobeGeometry seen = fitting::lobe_geometry(grazing, {2 * degree, 0, 0});
  CHECK(seen.cos_o == 0);
  CHECK(seen.cos_i == Approx(std::cos(18 * degree)));
  CHECK(seen_by({2 * degree, 0, 0}, grazing).theta_o.degrees() == Approx(90));
}
