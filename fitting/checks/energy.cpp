// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fitting/checks/albedo_quadrature.hpp"
#include "fitting/checks/checks.hpp"
#include "fitting/checks/fitted_model.hpp"
#include "fitting/checks/multiple_tests.hpp"
#include "fitting/checks/sample_places.hpp"
#include "fitting/distributions.hpp"

namespace gonio::fitting {
namespace {

constexpr std::array<double, 8> incidences_deg{0.25, 15, 30, 45, 60, 70, 80, 85};  // of a table; not 0, where azimuths are ambiguous
constexpr std::size_t enough_nodes = 12;                                           // outgoing directions, for an incidence to be looked at
constexpr double enough_covered = 0.5;                                             // of the projected hemisphere, for a pass

struct Incidence {
  double theta_deg = 0, phi_deg = 0;
  std::string channel;
  AlbedoEstimate estimate;

  double u() const { return estimate.u(); }
  double p() const { return u() > 0 ? normal_upper_tail((estimate.albedo - 1) / u()) : (estimate.albedo > 1 ? 0.0 : 1.0); }
};

void judge_model(Check& check, const AnalyticBrdf& brdf) {
  const std::vector<double> bound = brdf.albedo_bound();
  check.n = bound.size();
  check.effect = bound.empty() ? 0 : *std::max_element(bound.begin(), bound.end());
  check.effect_upper = check.effect;
  check.verdict = judge(*check.effect > 1, *check.effect, *check.effect, *check.threshold);
  check.detail = fmt::format("the largest directional albedo of the model is {:.4f}{}", *check.effect,
                             *check.effect > 1 ? ": it reflects more light than it receives" : "");
}

/// Every incidence of a data set with enough outgoing directions, channel by channel.
void add_incidences(const std::shared_ptr<const Dataset>& data, std::vector<Incidence>& out) {
  const Dataset& dataset = *data;
  Places index;
  std::vector<std::vector<std::size_t>> samples;
  for (std::size_t k = 0; k < dataset.size(); ++k) {
    PlaceKey key = dataset.symmetry.isotropic ? key_turned(dataset.angles[k]) : key_of(dataset.angles[k]);
    std::fill(key.begin() + 3, key.end(), 0.0);
    const std::size_t place = index.add(key);
    if (place == samples.size()) samples.emplace_back();
    samples[place].push_back(k);
  }
  std::erase_if(samples, [](const auto& place) { return place.size() < enough_nodes; });
  const auto model = samples.empty() ? nullptr : fitted_model(data);
  for (const auto& place : samples) {
    const GonioAngles& first = dataset.angles[place.front()];
    const Direction wi = dataset.symmetry.isotropic ? Direction::spherical(first.theta_i, degrees(0)) : first.wi();
    const auto model_albedo = model ? model->directional_albedo(first.theta_i) : std::vector<double>();
    for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
      AlbedoModel shape{[&](const Direction& wo) { return model->eval(wi, wo)[c]; }, model ? model_albedo[c] : 0};
      std::vector<AlbedoNode> nodes;
      bool positive = model != nullptr;
      for (const std::size_t k : place) {
        const auto mean = mean_of(dataset, c, {k});
        if (!mean || dataset.angles[k].wo().z() <= 0) continue;
        const PlaceKey key = dataset.symmetry.isotropic ? key_turned(dataset.angles[k]) : key_of(dataset.angles[k]);
        const Direction wo = Direction::trusted(key[3], key[4], key[5]);
        nodes.push_back({wo, mean->f, mean->u, mean->shared, model ? shape.f(wo) : 1});
        positive = positive && nodes.back().model > 0;
        if (!dataset.symmetry.bilateral || !dataset.symmetry.isotropic) continue;
        nodes.push_back(nodes.back());
        nodes.back().wo = Direction::trusted(key[3], -key[4], key[5]);
      }
      if (nodes.size() < enough_nodes) continue;
      if (!positive)
        for (AlbedoNode& node : nodes) node.model = 1;
      out.push_back(
          {first.theta_i.degrees(), first.phi_i.degrees(), dataset.channels[c].name, scattered_albedo(nodes, positive ? &shape : nullptr)});
    }
  }
}

void add_incidences(const Brdf& brdf, std::vector<Incidence>& out) {
  for (const double theta : incidences_deg) {
    const auto estimates = evaluated_albedo(brdf, Direction::spherical(degrees(theta), degrees(0)));
    for (std::size_t c = 0; c < estimates.size(); ++c) out.push_back({theta, 0, brdf.channels()[c].name, estimates[c]});
  }
}

void judge_incidences(Check& check, const std::vector<Incidence>& incidences, const CheckOptions& options) {
  check.n = incidences.size();
  const double q = normal_upper_quantile(options.alpha);
  const auto upper = [q](const Incidence& i) { return i.estimate.albedo + q * i.u() + i.estimate.missing_bound; };
  const auto least_likely =
      std::min_element(incidences.begin(), incidences.end(), [](const auto& a, const auto& b) { return a.p() < b.p(); });
  // Holm over incidences: its first step decides whether any is significant.
  check.p_value = std::min(1.0, least_likely->p() * static_cast<double>(incidences.size()));
  const bool significant = *check.p_value < options.alpha;
  const auto largest = std::max_element(incidences.begin(), incidences.end(),
                                        [](const auto& a, const auto& b) { return a.estimate.albedo < b.estimate.albedo; });
  const Incidence& shown = significant ? *least_likely : *largest;
  double covered = 1, highest = 0;
  for (const Incidence& i : incidences) covered = std::min(covered, i.estimate.covered), highest = std::max(highest, upper(i));
  check.effect = shown.estimate.albedo;
  check.u_effect = shown.u() > 0 ? std::optional(shown.u()) : std::nullopt;
  if (shown.u() > 0) check.statistic = (shown.estimate.albedo - 1) / shown.u();
  check.effect_upper = covered < enough_covered ? INFINITY : highest;
  check.verdict = judge(significant, *check.effect, *check.effect_upper, *check.threshold);
  check.detail = fmt::format(
      "largest directional albedo {:.4f} ± {:.2g} (incidence {:.4g}°, channel {}), from samples that cover {:.0f} % of the projected "
      "hemisphere",
      shown.estimate.albedo, shown.u(), shown.theta_deg, shown.channel, 100 * shown.estimate.covered);
  if (shown.estimate.missing_bound > 0) check.detail += fmt::format("; the rest may add {:.2g}", shown.estimate.missing_bound);
  std::vector<double> p;
  for (const Incidence& i : incidences) {
    p.push_back(i.p());
    check.incidences.push_back({i.theta_deg, i.phi_deg, i.channel, i.estimate.albedo, i.estimate.u_noise, i.estimate.u_quadrature,
                                i.estimate.u_scale, i.estimate.covered, i.estimate.missing_bound});
  }
  const auto adjusted = holm(p);
  const auto above = std::count_if(adjusted.begin(), adjusted.end(), [&](double value) { return value < options.alpha; });
  if (above > 0) check.detail += fmt::format("; {} of {} incidences and channels lie above 1 (Holm)", above, incidences.size());
  if (check.verdict == Verdict::vacuous) check.detail += "; the data cannot tell whether the whole stays below 1";
}

}  // namespace

Check check_energy(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "energy";
  check.unit = "albedo";
  check.threshold = 1 + options.margin;
  if (const auto* model = dynamic_cast<const AnalyticBrdf*>(subject.brdf.get())) {
    judge_model(check, *model);
    return check;
  }
  std::vector<Incidence> incidences;
  if (subject.brdf)
    add_incidences(*subject.brdf, incidences);
  else
    for (const auto& dataset : subject.datasets) add_incidences(dataset, incidences);
  std::erase_if(incidences, [](const Incidence& i) { return i.estimate.covered <= 0; });
  if (incidences.empty()) {
    check.verdict = Verdict::vacuous;
    check.detail = fmt::format("no incidence has {} outgoing directions to integrate over", enough_nodes);
    return check;
  }
  judge_incidences(check, incidences, options);
  return check;
}

}  // namespace gonio::fitting
