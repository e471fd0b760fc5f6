// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/table_symmetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fitting/checks/repeatability.hpp"
#include "fitting/distributions.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t pairs = 8192;
constexpr std::size_t blocks = 16;
constexpr double nearby_deg = 5;         // beyond the cells of every table in use
constexpr double model_rounding = 1e-9;  // relative, of analytic models
constexpr double farthest_deg = 80;

/// Weighted means over blocks: mean and its standard uncertainty.
struct Mean {
  double value = 0, u = 0;
};

Mean block_mean(const std::vector<TableDifference>& differences, const std::function<double(const TableDifference&)>& of) {
  double sum = 0, weight = 0;
  std::array<double, blocks> block_sum{}, block_weight{};
  for (std::size_t k = 0; k < differences.size(); ++k) {
    const std::size_t block = k * blocks / differences.size();
    const double w = differences[k].weight, value = of(differences[k]);
    sum += w * value, weight += w;
    block_sum[block] += w * value, block_weight[block] += w;
  }
  Mean out;
  if (!(weight > 0)) return out;
  out.value = sum / weight;
  double scatter = 0, used = 0;
  for (std::size_t b = 0; b < blocks; ++b)
    if (block_weight[b] > 0) scatter += std::pow(block_sum[b] / block_weight[b] - out.value, 2), used += 1;
  out.u = used > 1 ? std::sqrt(scatter / (used - 1) / used) : INFINITY;
  return out;
}

/// The relative difference of two values, from -2 to 2 whatever their signs; NaN where they have none.
double relative_difference(double f, double image) {
  const double sum = std::abs(f) + std::abs(image);
  return sum > 0 ? 2 * (f - image) / sum : std::nan("");
}

}  // namespace

bool holds_by_construction(const CheckSubject& subject, bool Symmetry::*property) {
  bool any = false, all = true;
  const auto ask = [&](const Symmetry& symmetry) { any = true, all = all && symmetry.*property; };
  for (const auto& dataset : subject.datasets) ask(dataset->symmetry);
  if (subject.datasets.empty()) {
    if (subject.observations) ask(subject.observations->symmetry());
    if (subject.brdf) ask(subject.brdf->symmetry());
  }
  return any && all;
}

GonioAngles spread_pair(std::size_t k, double& number) {
  // Roberts' generalised golden ratio for five dimensions: g^6 = g + 1.
  constexpr double g = 1.1347241384015194;
  std::array<double, 5> x{};
  double power = 1;
  for (double& value : x) {
    power /= g;
    value = std::fmod(0.5 + static_cast<double>(k + 1) * power, 1.0);
  }
  const double low = std::cos(farthest_deg * std::numbers::pi / 180);
  const auto zenith = [&](double v) { return radians(std::acos(low + (1 - low) * v)); };
  number = x[4];
  return {zenith(x[0]), radians(2 * std::numbers::pi * x[1]), zenith(x[2]), radians(2 * std::numbers::pi * x[3])};
}

void judge_table(Check& check, const std::vector<TableDifference>& differences, const std::string& tested, const CheckSubject& subject,
                 const CheckOptions& options) {
  const bool model = dynamic_cast<const AnalyticBrdf*>(subject.brdf.get()) != nullptr;
  const Mean square = block_mean(differences, [](const TableDifference& d) { return d.here * d.here; });
  const Mean shared = block_mean(differences, [](const TableDifference& d) { return d.here * d.nearby; });
  const double q = student_two_sided_quantile(1 - 2 * options.alpha, blocks - 1);
  const auto root = [](double value) { return std::sqrt(std::max(0.0, value)); };
  check.n = differences.size();
  check.effect = root(square.value);
  check.effect_upper = root(square.value + q * square.u);
  if (square.u > 0 && square.value > 0) check.u_effect = square.u / (2 * *check.effect);
  std::vector<double> sizes;
  for (const TableDifference& d : differences) sizes.push_back(std::abs(d.here));
  check.detail = fmt::format("{}: relative difference {} ± {} rms, {} median", tested, percent_text(*check.effect),
                             percent_text(check.u_effect.value_or(0)), percent_text(median_of(std::move(sizes))));
  if (model) {
    check.verdict = *check.effect > options.margin ? Verdict::fail : *check.effect > model_rounding ? Verdict::warn : Verdict::pass;
    return;
  }
  check.verdict = differences.empty()                                  ? Verdict::vacuous
                  : *check.effect_upper <= options.margin              ? Verdict::pass
                  : root(shared.value - q * shared.u) > options.margin ? Verdict::fail
                                                                       : Verdict::vacuous;
  check.detail += fmt::format("; {} of that is no noise, for places {:.0f}° apart share it", percent_text(root(shared.value)), nearby_deg);
  if (check.verdict == Verdict::vacuous)
    check.detail += fmt::format("; a table without uncertainties cannot tell the rest from noise within {}", percent_text(options.margin));
  if (check.verdict != Verdict::fail) return;
  std::vector<TableDifference> largest = differences;
  const auto size = [](const TableDifference& d) {
    return d.here * d.nearby > 0 ? d.weight * std::min(std::abs(d.here), std::abs(d.nearby)) : 0;
  };
  std::stable_sort(largest.begin(), largest.end(), [&](const auto& a, const auto& b) { return size(a) > size(b); });
  largest.resize(std::min(largest.size(), options.where));
  for (const TableDifference& d : largest)
    check.where.push_back({d.angles, subject.brdf->channels()[d.channel].name, d.ratio > 0 ? std::optional(d.ratio) : std::nullopt,
                           std::nullopt, std::nullopt, std::nullopt});
}

void judge_by_evaluation(Check& check, const CheckSubject& subject, const CheckOptions& options,
                         const std::function<GonioAngles(const GonioAngles&, double)>& image) {
  if (!subject.brdf) {
    check.verdict = Verdict::vacuous;
    check.detail = "a table is tested through its interpolation, which was not given";
    return;
  }
  const auto difference = [&](const GonioAngles& angles, double number, std::vector<double>& ratio) {
    const GonioAngles other = image(angles, number);
    const auto f = subject.brdf->eval(angles.wi(), angles.wo()), g = subject.brdf->eval(other.wi(), other.wo());
    std::vector<double> out;
    ratio.clear();
    for (std::size_t c = 0; c < f.size(); ++c)
      out.push_back(relative_difference(f[c], g[c])), ratio.push_back(g[c] > 0 ? f[c] / g[c] : std::nan(""));
    return out;
  };
  std::vector<TableDifference> differences;
  for (std::size_t k = 0; k < pairs; ++k) {
    double number = 0;
    const GonioAngles angles = spread_pair(k, number);
    // Every difference grows by steps of the same size; the sign of each keeps the pair inside the range.
    const auto moved = [](Angle theta) { return theta + degrees(theta.degrees() > farthest_deg / 2 ? -nearby_deg : nearby_deg); };
    const GonioAngles close{moved(angles.theta_i), angles.phi_i, moved(angles.theta_o), angles.phi_o + degrees(nearby_deg)};
    std::vector<double> ratio, unused;
    const auto here = difference(angles, number, ratio), nearby = difference(close, number, unused);
    for (std::size_t c = 0; c < here.size(); ++c)
      if (std::isfinite(here[c]) && std::isfinite(nearby[c]))
        differences.push_back({here[c], nearby[c], angles.theta_i.cos() * angles.theta_o.cos(), angles, c, ratio[c]});
  }
  judge_table(check, differences,
              fmt::format("{} pairs even in solid angle up to {:.0f}°, 2(f-f')/(|f|+|f'|) weighted by cos θi cos θo", differences.size(),
                          farthest_deg),
              subject, options);
}

}  // namespace gonio::fitting
