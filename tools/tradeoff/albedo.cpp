// SPDX-License-Identifier: BSD-3-Clause
// Topic albedo: the directional albedo of the mirror and the half-vector lobe by five ways, microseconds against error.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/lobe_geometry.hpp"
#include "brdf/model.hpp"
#include "brdf/phong_albedo.hpp"
#include "tools/tradeoff/lobe_integrals.hpp"
#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {
namespace {

constexpr std::array<double, 4> thetas_deg{0, 45, 80, 89};

/// One way to take ∫ cos^s cos θo dωo; `run` numbers independent repetitions of a random one.
struct Method {
  std::string name, setting;
  std::function<double(double s, Angle theta, int run)> integral;
  bool random = false;
};

std::vector<Method> methods(Lobe lobe, bool quick) {
  std::vector<Method> out;
  const auto add = [&](std::string name, std::string setting, auto integral) {
    out.push_back({std::move(name), std::move(setting), std::move(integral), false});
  };
  // The name is one for both lobes: what gonio itself uses.
  const std::string own = "closed form / double-exponential (gonio's own)";
  if (lobe == Lobe::mirror)
    add(own, "", [](double s, Angle theta, int) { return 2 * std::numbers::pi / (s + 2) * phong_albedo(s, theta); });
  else
    add(own, "", [](double s, Angle theta, int) { return half_vector_lobe_integral(s, theta); });
  if (lobe == Lobe::half_vector)
    for (int n = 8; n <= 2048; n *= quick ? 4 : 2)
      add("periodic midpoint rule (half vector only)", fmt::format("n = {}", n),
          [n](double s, Angle theta, int) { return periodic_rule(s, theta.cos(), theta.sin(), n); });
  for (int n = 16; n <= (quick ? 64 : 256); n *= 2)
    add("product quadrature", fmt::format("{}×{}", n, 2 * n),
        [lobe, rule = GaussLegendre(n)](double s, Angle theta, int) { return product_quadrature(lobe, s, theta, rule); });
  for (int n = 4; n <= (quick ? 64 : 256); n *= 2)
    add("lobe-mapped quadrature", fmt::format("{}×{}", n, 2 * n),
        [lobe, rule = GaussLegendre(n)](double s, Angle theta, int) { return lobe_mapped_quadrature(lobe, s, theta, rule); });
  for (std::size_t n = 100; n <= (quick ? 10000u : 1000000u); n *= 10)
    out.push_back(
        {"Monte Carlo on the lobe", fmt::format("N = 1e{}", std::lround(std::log10(static_cast<double>(n)))),
         [lobe, n](double s, Angle theta, int run) { return lobe_monte_carlo(lobe, s, theta, n, seed + static_cast<std::uint64_t>(run)); },
         true});
  return out;
}

/// One lobe value from two directions: no rule can be faster than the one value it would need at least.
double time_of_one_value(Lobe lobe, double least_run_s) {
  const Direction wi = Direction::spherical(40_deg, 0_deg);
  std::vector<Direction> outgoing;
  for (int k = 0; k < 64; ++k) outgoing.push_back(Direction::spherical(degrees(k), degrees(5 * k)));
  const auto values = [&] {
    double sum = 0;
    for (const Direction& wo : outgoing) {
      const LobeGeometry g = lobe_geometry(wi, wo);
      sum += cosine_power(lobe == Lobe::mirror ? g.log_cos_psi : g.log_cos_h, 10.0);
    }
    return sum;
  };
  return time_of(values, outgoing.size(), least_run_s).median_s;
}

/// 1e6 rather than 1e+06.
std::string plain(double s) { return s < 1e4 ? fmt::format("{:g}", s) : fmt::format("1e{}", std::lround(std::log10(s))); }

Point measured_point(const Method& method, double s, Lobe lobe, double least_run_s) {
  constexpr int random_runs = 9;
  Point point;
  point.method = method.name, point.setting = method.setting;
  double worst = -1;
  for (const double theta : thetas_deg) {
    const double truth = true_integral(lobe, s, theta);
    double square = 0;
    const int runs = method.random ? random_runs : 1;
    for (int run = 0; run < runs; ++run) {
      const double e = method.integral(s, degrees(theta), run) / truth - 1;
      square += e * e / runs;
    }
    const double error = std::sqrt(square);
    if (error > worst) worst = error, point.worst_at = fmt::format("θ = {:g}°", theta);
  }
  if (std::isfinite(worst)) point.error = worst;
  point.time = time_of(
      [&] {
        double sum = 0;
        for (const double theta : thetas_deg) sum += method.integral(s, degrees(theta), 0);
        return sum;
      },
      thetas_deg.size(), least_run_s);
  return point;
}

}  // namespace

Measured measure_albedo(const Effort& effort) {
  Measured out;
  out.title = "Directional albedo of a cosine lobe: error against time (worst of θ = 0, 45, 80, 89°)";
  out.time_of = "time per albedo";
  out.error_of = "relative error";
  out.time_unit_s = 1e-6, out.time_unit = "µs";
  out.targets = {1e-2, 1e-4, 1e-8, 1e-13};
  const std::vector<double> exponents = effort.quick ? std::vector<double>{10, 1e3, 1e6} : std::vector<double>{10, 100, 1e3, 1e4, 1e5, 1e6};
  const double least_run_s = effort.quick ? 1e-4 : 2e-3;
  double done = 0;
  const double all = 2.0 * static_cast<double>(exponents.size());
  for (const Lobe lobe : {Lobe::mirror, Lobe::half_vector}) {
    const double one_value = time_of_one_value(lobe, least_run_s);
    const auto list = methods(lobe, effort.quick);
    for (const double s : exponents) {
      Panel panel;
      panel.name = fmt::format("{} lobe, s = {}", lobe == Lobe::mirror ? "mirror (Phong)" : "half-vector (Blinn-Phong)", plain(s));
      panel.error_floors = {{std::numeric_limits<double>::epsilon() / 2, "rounding of a double, 1.1e-16"}};
      panel.limit = {one_value, fmt::format("one value of the lobe, {:.0f} ns", one_value * 1e9)};
      panel.drawn = s == 10 || s == 1e3 || s == 1e6;
      for (const Method& method : list) {
        effort.progress((done + static_cast<double>(&method - list.data()) / static_cast<double>(list.size())) / all, panel.name);
        Point point = measured_point(method, s, lobe, least_run_s);
        point.panel = panel.name;
        out.points.push_back(std::move(point));
      }
      out.panels.push_back(std::move(panel));
      ++done;
    }
  }
  return out;
}

}  // namespace gonio::tools::tradeoff
