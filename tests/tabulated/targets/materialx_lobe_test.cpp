// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/materialx_lobe.hpp"

#include <cmath>
#include <numbers>

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated::targets;

namespace {

/// Albedo of the GGX lobe with F = 1 and F = Schlick's weight alone, by a plain sum over the hemisphere of half vectors.
materialx::AlbedoParts integrated(double cos_o, double alpha) {
  const double sine = std::sqrt(1 - cos_o * cos_o);
  const Direction wo = Direction::trusted(sine, 0, cos_o);
  constexpr int nt = 400, np = 200;
  double all = 0, edge = 0;
  for (int a = 0; a < nt; ++a)
    for (int b = 0; b < np; ++b) {
      const double u = (a + 0.5) / nt, t = std::numbers::pi / 2 * u * u, dt = std::numbers::pi * u / nt;
      const double p = 2 * std::numbers::pi * (b + 0.5) / np;
      const Direction h = Direction::spherical(radians(t), radians(p));
      const double c = dot(wo, h), z = 2 * c * h.z() - wo.z();
      if (!(c > 0 && z > 0)) continue;
      const Direction wi = Direction::trusted(2 * c * h.x() - wo.x(), 2 * c * h.y() - wo.y(), z);
      const MicrofacetPair pair(wi, wo);
      const double weight = 4 * c * z * std::sin(t) * dt * (2 * std::numbers::pi / np);
      const double f = ggx_d(pair, alpha, alpha) * correlated_visibility(wi, wo, alpha, alpha) * weight, w = schlick_weight(c);
      all += f, edge += f * w;
    }
  return {all - edge, edge};
}

}  // namespace

TEST_CASE("MaterialX's fit to the albedo of the lobe is near the albedo of the lobe") {
  for (const double alpha : {0.1, 0.3, 0.6})
    for (const double cosine : {0.3, 0.6, 0.95}) {
      const auto fit = materialx::lobe_albedo(cosine, alpha), exact = integrated(cosine, alpha);
      INFO("alpha " << alpha << ", cosine " << cosine);
      // What a rational function of few terms is good for; a wrong coefficient misses by more.
      CHECK(fit.a == Approx(exact.a).margin(0.02));
      CHECK(fit.b == Approx(exact.b).margin(0.02));
    }
}

TEST_CASE("the compensated lobe of a perfect mirror reflects nearly everything") {
  for (const double alpha : {0.2, 0.7}) {
    const double cosine = 0.8;
    const auto exact = integrated(cosine, alpha);
    const Direction wo = Direction::trusted(0.6, 0, cosine), wi = Direction::trusted(-0.6, 0, cosine);
    const materialx::LobeAt lobe = materialx::lobe_at(MicrofacetPair(wi, wo), {alpha, alpha});
    CHECK((exact.a + exact.b) * (1 + lobe.missing) == Approx(1).margin(0.02));
    CHECK(lobe.response(1) == Approx((1 + lobe.missing) * lobe.lobe).epsilon(1e-14));
    CHECK(lobe.throughput(1, 1, 1) == Approx(0).margin(1e-12));
  }
}
