// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fit_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fitting/distributions.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr double alpha = 0.01, margin = 0.02;
/// A second minimum within this many budgets of the best (chi² rise of about 4 each) deserves to be looked at.
constexpr double near_budgets = 3;

}  // namespace

Check energy_bound(const FitResult& result, const ModelKernel& kernel, const std::vector<Matrix>& covariance, int threads) {
  struct Albedo {
    double value = 0, variance = 0;
  };
  std::vector<Albedo> each(result.values.size());
  for_each_index(each.size(), threads, [&](std::size_t c) {
    std::vector<double> values = result.values[c], gradient(values.size()), above(kernel.linear), below(kernel.linear);
    const auto [theta, phi] = kernel.info->brightest_incidence(values.data());
    kernel.info->albedo(theta, phi, values.data() + kernel.linear, gradient.data());
    each[c].value =
        kernel.info->closed_albedo
            ? kernel.info->albedo_bound(values.data())
            : std::inner_product(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kernel.linear), gradient.begin(), 0.0);
    for (std::size_t j = kernel.linear; j < values.size(); ++j) {
      const double at = values[j], step = 1e-5 * std::abs(at);
      values[j] = at + step;
      kernel.info->albedo(theta, phi, values.data() + kernel.linear, above.data());
      values[j] = at - step;
      kernel.info->albedo(theta, phi, values.data() + kernel.linear, below.data());
      values[j] = at;
      if (!(step > 0)) continue;
      for (std::size_t k = 0; k < kernel.linear; ++k) gradient[j] += values[k] * (above[k] - below[k]) / (2 * step);
    }
    // A parameter that is fixed or at its bound has no variance to add.
    for (std::size_t a = 0; a < gradient.size(); ++a)
      for (std::size_t b = 0; b < gradient.size(); ++b)
        if (std::isfinite(covariance[c](a, b))) each[c].variance += gradient[a] * covariance[c](a, b) * gradient[b];
  });
  Albedo most{-1, 0};
  for (const Albedo& one : each)
    if (one.value > most.value) most = one;
  const double worst = most.value;
  Check check;
  check.id = "energy_bound";
  check.unit = std::string("1");
  check.threshold = 1;
  check.n = result.values.size();
  check.effect = worst;
  const double variance = most.variance + std::pow(worst * result.u_scale.value_or(0), 2);
  check.u_effect = variance > 0 ? std::optional(std::sqrt(variance)) : std::nullopt;
  const double u = check.u_effect.value_or(0), z = u > 0 ? (worst - 1) / u : (worst > 1 ? 1e9 : -1e9);
  check.statistic = u > 0 ? std::optional(z) : std::nullopt;
  check.p_value = u > 0 ? std::optional(normal_upper_tail(z)) : std::nullopt;
  check.effect_upper = worst + normal_upper_quantile(alpha) * u;
  check.verdict = judge(normal_upper_tail(z) < alpha, worst, *check.effect_upper, 1 + margin);
  check.detail = fmt::format("the fitted model reflects at most {:.4f} ± {:.2g} of the light it receives{}", worst, u,
                             worst > 1 ? ", more than all of it" : "");
  return check;
}

Check at_bound(const FitResult& result) {
  Check check;
  check.id = "at_bound";
  check.n = result.parameters.size();
  std::string names;
  for (const FittedParameter& parameter : result.parameters) {
    if (parameter.kind == IntervalKind::fixed) continue;
    if (parameter.value > parameter.lower && parameter.value < parameter.upper) continue;
    names +=
        fmt::format("{}{}{}", names.empty() ? "" : ", ", parameter.name,
                    parameter.channel && result.channels.size() > 1 ? fmt::format(" of {}", result.channels[*parameter.channel].name) : "");
  }
  for (const NuisanceParameter& p : result.nuisance)
    if (std::abs(p.value) >= p.bound) names += fmt::format("{}{}", names.empty() ? "" : ", ", p.name);
  check.verdict = names.empty() ? Verdict::pass : Verdict::warn;
  check.detail =
      names.empty() ? "no parameter lies at an end of its search range" : fmt::format("at an end of the search range: {}", names);
  return check;
}

Check adequacy(double chi2, double dof, double signal_to_noise2, std::size_t n, bool has_uncertainty) {
  Check check;
  check.id = "adequacy";
  check.unit = std::string("1");
  check.threshold = margin;
  check.n = n;
  if (!has_uncertainty || !(dof >= 1)) {
    check.verdict = Verdict::vacuous;
    check.detail = has_uncertainty ? "there are no more samples than parameters, so any model of this size fits"
                                   : "the data carry no uncertainty, so no residual can be called too large";
    return check;
  }
  const double spread = std::sqrt(2 * dof);  // of chi²
  const auto misfit = [&](double excess) { return std::sqrt(std::max(0.0, excess) / signal_to_noise2); };
  check.statistic = chi2;
  check.p_value = chi2_upper_tail(chi2, dof);
  check.effect = misfit(chi2 - dof);
  check.effect_upper = misfit(chi2 - dof + normal_upper_quantile(alpha) * spread);
  if (*check.effect > 0) check.u_effect = spread / signal_to_noise2 / (2 * *check.effect);
  check.verdict = judge(*check.p_value < alpha, *check.effect, *check.effect_upper, margin);
  check.detail = fmt::format("chi² {:.4g} with {:.0f} degrees of freedom: the model misses the data by {:.2g} % beyond their noise", chi2,
                             dof, 100 * *check.effect);
  return check;
}

Check second_minimum(const FitResult& result, const ModelInfo& model, double budget, double best_cost) {
  Check check;
  check.id = "second_minimum";
  check.n = result.other_minima.size();
  if (result.other_minima.empty()) {
    check.verdict = Verdict::pass;
    check.detail = "the profile over the nonlinear parameters has one minimum";
    return check;
  }
  const auto nearest = std::min_element(result.other_minima.begin(), result.other_minima.end(),
                                        [](const OtherMinimum& a, const OtherMinimum& b) { return a.cost < b.cost; });
  const bool near = nearest->cost <= best_cost + near_budgets * budget;
  if (std::isfinite(nearest->cost_ratio)) check.effect = nearest->cost_ratio;
  check.unit = std::string("1");
  check.verdict = near ? Verdict::warn : Verdict::pass;
  std::string where;
  for (std::size_t j = 0; j < nearest->nonlinear.size(); ++j)
    where += fmt::format("{}{} = {:.4g}", j == 0 ? "" : ", ", model.parameters[model.linear_count + j].name, nearest->nonlinear[j]);
  check.detail = fmt::format("another local minimum at {} costs {:.3g} times as much{}; it often means a second lobe", where,
                             nearest->cost_ratio, near ? ", hardly worse than the best" : "");
  return check;
}

Check identifiability(const FitResult& result) {
  Check check;
  check.id = "identifiability";
  check.unit = std::string("1");
  check.threshold = 0;
  std::string names;
  std::size_t count = 0;
  for (const FittedParameter& parameter : result.parameters) {
    if (parameter.kind == IntervalKind::fixed) continue;
    ++check.n;
    if (parameter.kind == IntervalKind::interval) continue;
    ++count;
    names += fmt::format("{}{}{}", names.empty() ? "" : ", ", parameter.name,
                         parameter.channel && result.channels.size() > 1 ? " of " + result.channels[*parameter.channel].name : "");
  }
  check.effect = static_cast<double>(count);
  check.verdict = count == 0 ? Verdict::pass : Verdict::warn;
  if (count == 0) {
    check.detail = "the data limit every parameter on both sides";
    return check;
  }
  std::string instead;
  for (const Determined& found : result.determined)
    instead +=
        fmt::format("{}{}{} = {:.5g} [{:.5g}, {:.5g}]", instead.empty() ? "; determined is " : ", ", found.expression,
                    result.channels.size() > 1 ? " of " + result.channels[found.channel].name : "", found.value, found.low, found.high);
  check.detail = fmt::format("not identifiable: {}{}", names, instead);
  return check;
}

}  // namespace gonio::fitting
