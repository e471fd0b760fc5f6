// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/abg_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "brdf/error.hpp"

namespace gonio::tabulated {
namespace {

constexpr double least_log_b = -27.631021115928547 /* ln 1e-12 */, largest_log_b = 13.815510557964274 /* ln 1e6 */, largest_g = 20;
constexpr int steps = 200;

using Vector = std::array<double, 3>;  ///< ln A, ln B, g

struct Sample {
  double log_x;  ///< -infinity at 0
  double log_f;
};

/// ln(B + x^g) from ln B and g ln x, without overflow.
double log_sum(double log_b, double log_power) {
  const double high = std::max(log_b, log_power);
  return high + std::log1p(std::exp(std::min(log_b, log_power) - high));
}

double power_of(const Sample& sample, double g) { return g == 0 ? 0 : g * sample.log_x; }

/// Σ (ln f - model)²; the best ln A is the mean difference, so it is set here.
double cost(const std::vector<Sample>& samples, Vector& at) {
  double sum = 0, squares = 0;
  for (const Sample& sample : samples) {
    const double residual = sample.log_f + log_sum(at[1], power_of(sample, at[2]));
    sum += residual;
    squares += residual * residual;
  }
  const auto n = static_cast<double>(samples.size());
  at[0] = sum / n;
  return std::max(0.0, squares - sum * sum / n);
}

/// Normal equations in ln B and g with ln A eliminated: derivatives less their means.
struct Equations {
  double bb = 0, bg = 0, gg = 0, rb = 0, rg = 0;
};

Equations equations(const std::vector<Sample>& samples, const Vector& at) {
  double mean_b = 0, mean_g = 0;
  std::vector<std::array<double, 3>> rows;
  for (const Sample& sample : samples) {
    const double log_power = power_of(sample, at[2]), total = log_sum(at[1], log_power), part = std::exp(log_power - total);
    const double db = -std::exp(at[1] - total), dg = part > 0 ? -part * sample.log_x : 0;
    rows.push_back({db, dg, sample.log_f - at[0] + total});
    mean_b += db, mean_g += dg;
  }
  mean_b /= static_cast<double>(rows.size()), mean_g /= static_cast<double>(rows.size());
  Equations out;
  for (const auto& [db, dg, residual] : rows) {
    const double b = db - mean_b, g = dg - mean_g;
    out.bb += b * b, out.bg += b * g, out.gg += g * g, out.rb += b * residual, out.rg += g * residual;
  }
  return out;
}

/// Marquardt's damping; a step out of the bounds is cut at them.
double descend(const std::vector<Sample>& samples, Vector& at) {
  double best = cost(samples, at), damping = 1e-3;
  constexpr double largest_damping = 1e12, relative_gain = 1e-14;
  for (int step = 0; step < steps && damping < largest_damping; ++step) {
    const Equations e = equations(samples, at);
    const double bb = e.bb * (1 + damping) + std::numeric_limits<double>::min(),
                 gg = e.gg * (1 + damping) + std::numeric_limits<double>::min();
    const double determinant = bb * gg - e.bg * e.bg;
    if (!(determinant > 0)) {
      damping *= 10;
      continue;
    }
    Vector next{0, std::clamp(at[1] + (gg * e.rb - e.bg * e.rg) / determinant, least_log_b, largest_log_b),
                std::clamp(at[2] + (bb * e.rg - e.bg * e.rb) / determinant, 0.0, largest_g)};
    const double reached = cost(samples, next);
    if (!(reached < best)) {
      damping *= 10;
      continue;
    }
    const bool done = best - reached <= relative_gain * best;
    at = next, best = reached, damping /= 10;
    if (done) break;
  }
  return best;
}

}  // namespace

double AbgParameters::at(double x) const noexcept { return a / (b + (g == 0 ? 1 : std::exp(g * std::log(x)))); }

AbgFit fit_abg(std::span<const double> x, std::span<const double> f) {
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (f[k] > 0 && std::isfinite(f[k])) samples.push_back({std::log(x[k]), std::log(f[k])});
  if (std::ssize(samples) < least_abg_samples)
    throw Error(ErrorKind::input, {"the values to fit A, B and g to", std::to_string(samples.size()) + " positive ones", "at least four"});
  Vector best{};
  double best_cost = std::numeric_limits<double>::infinity();
  for (const double g : {0.5, 1.0, 2.0, 3.0, 5.0})
    for (const double log_b : {-14.0, -9.0, -4.0, 0.0}) {
      Vector at{0, log_b, g};
      const double reached = descend(samples, at);
      if (reached < best_cost) best = at, best_cost = reached;
    }
  return {{std::exp(best[0]), std::exp(best[1]), best[2]}, std::sqrt(best_cost / static_cast<double>(samples.size()))};
}

}  // namespace gonio::tabulated
