// SPDX-License-Identifier: BSD-3-Clause
// A parameter the data do not determine has no variance; a combination they do determine has one.
#include "fitting/covariance.hpp"

#include <cmath>

#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

struct Setting {
  Terms terms;
  SearchSpace space;
  Linearisation at;
  ParameterPlaces places{1, 2, 1};
};

/// A half-vector lobe of s = 1e6 linearised on zenith angles in steps of `step_deg`.
Setting setting(double step_deg) {
  std::vector<GonioAngles> angles;
  for (double theta = 0; theta <= 80; theta += step_deg) angles.push_back({degrees(theta), degrees(0), degrees(theta), degrees(0)});
  const double none = std::nan("");
  Terms terms = make_terms(*observe(readings(lobe("blinn-phong", .2, .3, 1e6), angles, {1e-3, 0, 0}, 1)), model_kernel("blinn-phong"),
                           Metric::linear, 1);
  SearchSpace space(terms.kernel, {{none, none, none}}, {true});
  Linearisation at = linearise(terms, space, {{{none, none}, {}, {}}}, {{.2, .3}}, std::vector<double>{1e6}, {}, 1);
  return {std::move(terms), std::move(space), std::move(at)};
}

}  // namespace

TEST_CASE("a lobe seen in its peak alone has neither sigma of rho_s nor of s, and its peak has one") {
  const Setting peak_only = setting(10);
  const Matrix found = covariance(peak_only.at, peak_only.places, peak_only.space, 1);
  CHECK(found(0, 0) > 0);
  CHECK(std::isnan(found(1, 1)));
  CHECK(std::isnan(found(2, 2)));
  CHECK(std::isnan(found(0, 2)));
  // d (rho_s (s + 8)): what the peak measures.
  CHECK(variance_of(peak_only.at, peak_only.places, peak_only.space, 1, {0, 1e6 + 8, .3}));
  CHECK(!variance_of(peak_only.at, peak_only.places, peak_only.space, 1, {0, 1, 0}));
}

TEST_CASE("a lobe seen on its flank has every sigma, and shared errors move what they should") {
  const Setting fine = setting(0.02);
  const Matrix found = covariance(fine.at, fine.places, fine.space, 1);
  for (std::size_t a = 0; a < 3; ++a) {
    CHECK(found(a, a) > 0);
    for (std::size_t b = 0; b < 3; ++b) CHECK(std::abs(found(a, b)) <= std::sqrt(found(a, a) * found(b, b)) * (1 + 1e-9));
  }
  const double none = std::nan("");
  const Change scale = [](std::size_t, std::size_t, double fitted) { return .02 * fitted; };
  const Linearisation shifted =
      linearise(fine.terms, fine.space, {{{none, none}, {}, {}}}, {{.2, .3}}, std::vector<double>{1e6}, std::span(&scale, 1), 1);
  const std::vector<double> move = responses(shifted, fine.places, fine.space).front();
  CHECK(std::abs(move[0]) == Approx(.02 * .2).epsilon(0.05));
  CHECK(std::abs(move[1]) == Approx(.02 * .3).epsilon(0.05));
  CHECK(std::abs(move[2]) < 1e6 * 2e-3);
}
