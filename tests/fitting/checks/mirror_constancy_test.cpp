// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "tabulated/half_difference_table.hpp"
#include "tests/fitting/checks/sweeps.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

/// A MERL table of one lobe whose cells at theta_h = 0 vary with phi_d by `ripple` and all cells by `sided` sin 2 phi_d.
CheckSubject merl(double ripple, double sided) {
  constexpr std::size_t h = 90, d = 90, p = 180;
  std::vector<double> plane(h * d * p);
  for (std::size_t i = 0; i < h; ++i)
    for (std::size_t j = 0; j < d; ++j)
      for (std::size_t k = 0; k < p; ++k) {
        const double phi = 3.14159265358979 * static_cast<double>(k) / p,
                     theta_h = static_cast<double>(i * i) / 90 * 3.14159265358979 / 180;
        plane[(i * d + j) * p + k] =
            .1 + std::exp(-20 * theta_h * theta_h) * (1 + (i == 0 ? ripple * std::cos(2 * phi) : 0) + sided * std::sin(2 * phi));
      }
  const auto planes = tabulated::MerlPlanes::owning({plane, plane, plane});
  return {{},
          std::shared_ptr<const Observations>(tabulated::observe_merl(planes, tabulated::MerlNodes::left)),
          std::make_shared<tabulated::HalfDifferenceTable>(planes, tabulated::MerlNodes::left)};
}

}  // namespace

TEST_CASE("MERL: reciprocity and isotropy cannot fail, bilateral symmetry and the mirror direction can") {
  const CheckSubject fair = merl(0, 0), rippled = merl(.2, 0), sided = merl(0, .2);
  CHECK(check_reciprocity(fair, {}).verdict == Verdict::vacuous);
  CHECK(check_isotropy(fair, {}).verdict == Verdict::vacuous);
  CHECK(check_bilateral(fair, {}).verdict == Verdict::pass);
  CHECK(check_mirror_constancy(fair, {}).verdict == Verdict::pass);
  const Check ripple = check_mirror_constancy(rippled, {});
  INFO(ripple.detail);
  CHECK(ripple.verdict == Verdict::fail);
  CHECK(*ripple.effect == Approx(.2 / 1.1 / std::sqrt(2.)).epsilon(.05));
  CHECK(check_bilateral(sided, {}).verdict == Verdict::fail);
}

TEST_CASE("mirror constancy is skipped for what is no table in half and difference angles") {
  CHECK(check_mirror_constancy({}, {}).verdict == Verdict::skipped);
  CHECK(check_mirror_constancy({{}, nullptr, std::make_shared<AnalyticBrdf>(lobe("blinn-phong", .3, .2, 20))}, {}).verdict ==
        Verdict::skipped);
  const auto checks = run_checks({{}, nullptr, std::make_shared<AnalyticBrdf>(lobe("blinn-phong", .3, .2, 20))}, {});
  for (const Check& check : checks) CHECK(check.verdict != Verdict::skipped);
}
