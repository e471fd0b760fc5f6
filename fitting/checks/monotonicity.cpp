// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/isotonic.hpp"
#include "fitting/checks/sample_places.hpp"
#include "fitting/distributions.hpp"

namespace gonio::fitting {
namespace {

constexpr int draws = 200;  // of the bootstrap: its mean and variance to 10 %
constexpr std::size_t enough_points = 5;
constexpr double in_plane = 0.02;  // |sin(phi_o - phi_i)|, a good degree
constexpr double model_rounding = 1e-9;

/// Values along growing theta_h at fixed rest, outward from the mirror direction.
struct Line {
  std::vector<double> f, u;  ///< u: empty if any is unknown
  std::string name;
};

/// In-plane scans of every incidence and channel, each side of the mirror direction apart.
std::vector<Line> lines_of(const Dataset& dataset) {
  Places incidences;
  struct Point {
    double theta_h;
    std::size_t sample;
  };
  std::map<std::pair<std::size_t, bool>, std::vector<Point>> scans;
  for (std::size_t k = 0; k < dataset.size(); ++k) {
    const GonioAngles& a = dataset.angles[k];
    PlaceKey key = key_of(a);
    std::fill(key.begin() + 3, key.end(), 0.0);
    const double s = (a.phi_o - a.phi_i).sin() * a.theta_o.sin();
    if (std::abs(s) > in_plane * std::abs(a.theta_o.sin())) continue;
    // Signed angle of wo from the normal, positive on the mirror side.
    const double signed_o = -(a.phi_o - a.phi_i).cos() * a.theta_o.radians(), x = signed_o - std::abs(a.theta_i.radians());
    scans[{incidences.add(key), x >= 0}].push_back({std::abs(x), k});
  }
  std::vector<Line> out;
  for (auto& [key, points] : scans) {
    std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.theta_h < b.theta_h; });
    for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
      Line line;
      for (const Point& point : points) {
        if (!std::isfinite(dataset.f[c][point.sample])) continue;
        line.f.push_back(dataset.f[c][point.sample]);
        line.u.push_back(dataset.has_uncertainty() ? dataset.u[c][point.sample] : std::nan(""));
      }
      if (line.f.size() < enough_points) continue;
      if (!std::all_of(line.u.begin(), line.u.end(), [](double u) { return u > 0 && std::isfinite(u); })) line.u.clear();
      line.name =
          fmt::format("incidence {:.4g}°, {} the mirror direction, channel {}", dataset.angles[points.front().sample].theta_i.degrees(),
                      key.second ? "beyond" : "before", dataset.channels[c].name);
      out.push_back(std::move(line));
    }
  }
  return out;
}

/// Lines of growing theta_h at fixed (theta_d, phi_d), as far as both directions stay above the horizon.
std::vector<Line> lines_of(const Brdf& brdf) {
  std::vector<Line> out;
  for (const double theta_d : {5., 20., 35., 50., 65.})
    for (const double phi_d : {0.5, 45., 90., 135.}) {
      std::vector<Line> lines(brdf.channels().size());
      for (double theta_h = 0.5; theta_h < 85; theta_h += 0.5) {
        const DirectionPair pair = directions({degrees(theta_h), degrees(0), degrees(theta_d), degrees(phi_d)});
        if (pair.wi.z() <= in_plane || pair.wo.z() <= in_plane) break;
        const auto f = brdf.eval(pair.wi, pair.wo);
        for (std::size_t c = 0; c < f.size(); ++c)
          if (std::isfinite(f[c])) lines[c].f.push_back(f[c]);
      }
      for (std::size_t c = 0; c < lines.size(); ++c) {
        lines[c].name = fmt::format("theta_d {:.4g}°, phi_d {:.4g}°, channel {}", theta_d, phi_d, brdf.channels()[c].name);
        if (lines[c].f.size() >= enough_points) out.push_back(std::move(lines[c]));
      }
    }
  return out;
}

double distance2(const std::vector<double>& values, const std::vector<double>& weights) {
  const auto nearest = non_increasing(values, weights);
  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k) sum += weights[k] * (values[k] - nearest[k]) * (values[k] - nearest[k]);
  return sum;
}

struct Distance {
  double statistic = 0, expected = 0, variance = 0;  ///< Σ (f - g)²/u² and its moments where g is the truth
  double signal = 0;                                 ///< Σ g²/u²
  std::size_t values = 0;
  double worst = 0;
  std::string worst_name;
};

/// Distance of lines with uncertainties to the nearest falling ones. Its distribution comes from a parametric bootstrap about them, which
/// is the exact mixture of χ² where the truth is flat and less where it falls.
Distance distance_with_noise(const std::vector<Line>& lines) {
  Distance out;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const Line& line : lines) {
    std::vector<double> weights;
    for (const double u : line.u) weights.push_back(1 / (u * u));
    const auto nearest = non_increasing(line.f, weights);
    const double statistic = distance2(line.f, weights);
    double mean = 0, square = 0;
    for (int draw = 0; draw < draws; ++draw) {
      std::vector<double> again;
      for (std::size_t k = 0; k < nearest.size(); ++k) again.push_back(nearest[k] + line.u[k] * normal(random));
      const double t = distance2(again, weights);
      mean += t / draws, square += t * t / draws;
    }
    out.statistic += statistic, out.expected += mean, out.variance += square - mean * mean;
    for (std::size_t k = 0; k < nearest.size(); ++k) out.signal += nearest[k] * nearest[k] * weights[k];
    out.values += line.f.size();
    if (statistic - mean > out.worst) out.worst = statistic - mean, out.worst_name = line.name;
  }
  return out;
}

Distance distance_without_noise(const std::vector<Line>& lines) {
  Distance out;
  for (const Line& line : lines) {
    const double statistic = distance2(line.f, std::vector<double>(line.f.size(), 1.0));
    out.statistic += statistic;
    for (const double f : line.f) out.signal += f * f;
    out.values += line.f.size();
    if (statistic > out.worst) out.worst = statistic, out.worst_name = line.name;
  }
  return out;
}

void judge_with_noise(Check& check, const Distance& distance, const CheckOptions& options) {
  // The statistic as a scaled χ² with the bootstrap's mean and variance (Satterthwaite).
  const double scale = distance.variance / (2 * std::max(distance.expected, model_rounding));
  const double p = scale > 0 ? chi2_upper_tail(distance.statistic / scale, distance.expected / scale) : 1;
  const double spread = normal_upper_quantile(options.alpha) * std::sqrt(distance.variance);
  const double excess = distance.statistic - distance.expected;
  check.statistic = distance.statistic;
  check.p_value = p;
  check.effect = std::sqrt(std::max(0.0, excess) / distance.signal);
  check.effect_upper = std::sqrt(std::max(0.0, excess + spread) / distance.signal);
  check.verdict = judge(p < options.alpha, *check.effect, *check.effect_upper, options.margin);
  check.detail = fmt::format("{} values: they miss the nearest profile that falls with theta_h by {} beyond noise", distance.values,
                             percent_text(*check.effect));
  if (p < options.alpha) check.detail += ", most at " + distance.worst_name;
  if (check.verdict == Verdict::vacuous) check.detail += fmt::format("; the data cannot tell within {}", percent_text(options.margin));
}

}  // namespace

Check check_monotonicity(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "monotonicity";
  check.unit = "relative";
  check.threshold = options.margin;
  std::vector<Line> lines;
  for (const auto& dataset : subject.datasets)
    for (Line& line : lines_of(*dataset)) lines.push_back(std::move(line));
  const bool samples = !subject.datasets.empty();
  if (!samples && subject.brdf) lines = lines_of(*subject.brdf);
  const bool noisy = std::any_of(lines.begin(), lines.end(), [](const Line& line) { return !line.u.empty(); });
  if (noisy) std::erase_if(lines, [](const Line& line) { return line.u.empty(); });
  const Distance distance = noisy ? distance_with_noise(lines) : distance_without_noise(lines);
  check.n = distance.values;
  if (!(distance.signal > 0)) {
    check.verdict = Verdict::vacuous;
    check.detail = fmt::format("no in-plane scan has {} values on one side of the mirror direction", enough_points);
    return check;
  }
  if (noisy) {
    judge_with_noise(check, distance, options);
  } else {
    check.effect = std::sqrt(distance.statistic / distance.signal);
    const bool model = dynamic_cast<const AnalyticBrdf*>(subject.brdf.get()) != nullptr;
    check.verdict = *check.effect <= (model ? model_rounding : options.margin) ? Verdict::pass : model ? Verdict::warn : Verdict::vacuous;
    check.detail = fmt::format("{} values: they miss the nearest profile that falls with theta_h by {} (rms){}", distance.values,
                               percent_text(*check.effect), model ? "" : ", noise included, because no uncertainty is known");
    if (check.verdict != Verdict::pass) check.detail += ", most at " + distance.worst_name;
  }
  if (check.verdict == Verdict::fail) check.verdict = Verdict::warn;
  if (check.verdict == Verdict::warn)
    check.detail += "; no law of physics, but no single lobe about the half vector or the mirror direction can follow it";
  return check;
}

}  // namespace gonio::fitting
