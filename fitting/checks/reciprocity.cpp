// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/contrasts.hpp"
#include "fitting/checks/interpolated_pairs.hpp"
#include "fitting/checks/paired_places.hpp"
#include "fitting/checks/repeatability.hpp"
#include "fitting/checks/symmetry_verdict.hpp"
#include "fitting/checks/table_symmetry.hpp"

namespace gonio::fitting {
namespace {

const std::vector<std::string> pattern_names{"the difference of the cosines", "the x component", "the y component", "time"};
// The cosines are what field, spot and cosine errors go with: they get most of the significance (power at 0.1 % asymmetry).
const std::vector<double> pattern_share{0.7, 0.05, 0.05, 0.1};

std::vector<double> antisymmetric_patterns(const GonioAngles& angles, double time) {
  const Direction wi = angles.wi(), wo = angles.wo();
  return {wi.z() - wo.z(), wi.x() - wo.x(), wi.y() - wo.y(), time};
}

Contrasts partner_pairs(const CheckSubject& subject, PlaceKey (*key)(const GonioAngles&) noexcept) {
  Contrasts pairs;
  pairs.pattern_names = pattern_names;
  pairs.pattern_share = pattern_share;
  add_pairs(subject.datasets, {key, exchanged}, antisymmetric_patterns, pairs);
  return pairs;
}

/// The median |difference| of a sample and its partner's value over their mean, and the same statistic for pairs that are no partners:
/// a negative control (Capderou and Michel).
std::string departures(const Contrasts& pairs) {
  const std::size_t n = pairs.contrasts.size();
  const auto median = [&](std::size_t shift) {
    std::vector<double> departure;
    for (std::size_t k = 0; k < n; ++k) {
      const Contrast& other = pairs.contrasts[(k + shift) % n];
      const double one = pairs.readings[pairs.contrasts[k].terms[0].reading].f;
      const double partner = 2 * other.mean - pairs.readings[other.terms[0].reading].f;
      if (one + partner > 0) departure.push_back(2 * std::abs(one - partner) / (one + partner));
    }
    return median_of(std::move(departure));
  };
  return fmt::format("median |difference| {} (arbitrary pairs {})", percent_text(median(0)), percent_text(median(n / 2)));
}

/// Without stated uncertainties: mirror pairs differ by the instrument or by the sample, but never by reciprocity; repeats by noise alone.
std::optional<Repeatability> instrument_scatter(const CheckSubject& subject, double neighbour_scatter, std::size_t neighbours) {
  if (std::any_of(subject.datasets.begin(), subject.datasets.end(), [](const auto& d) { return d->has_uncertainty(); }))
    return std::nullopt;
  auto scatter = repeated_readings(subject.datasets);
  if (scatter) scatter->relative *= std::numbers::sqrt2;  // of a difference
  const MedianEffect mirror = median_effect(mirror_pairs(subject.datasets), 0.5);
  if (neighbour_scatter > 0 && (!scatter || neighbour_scatter > scatter->relative))
    scatter = Repeatability{neighbour_scatter, neighbours, "samples and their neighbours at other incidences"};
  if (mirror.n > 0 && (!scatter || mirror.median > scatter->relative)) return Repeatability{mirror.median, mirror.n, "mirror pairs"};
  return scatter;
}

}  // namespace

Check check_reciprocity(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "reciprocity";
  check.unit = "relative";
  check.threshold = options.margin;
  if (holds_by_construction(subject, &Symmetry::reciprocal)) {
    check.verdict = Verdict::vacuous;
    check.detail = "cannot fail: it holds by construction of the data or the model, so nothing was tested";
    if (!holds_by_construction(subject, &Symmetry::bilateral)) check.detail += "; bilateral symmetry can fail instead";
    return check;
  }
  if (subject.datasets.empty()) {
    judge_by_evaluation(check, subject, options, [](const GonioAngles& angles, double) { return exchanged(angles); });
    return check;
  }
  Contrasts pairs = partner_pairs(subject, key_of);
  std::string kind;
  // A stage that never turns has exact partners in the plane of incidence only, and a half-plane has them folded.
  const std::array<std::pair<PlaceKey (*)(const GonioAngles&) noexcept, const char*>, 2> assumptions{
      {{key_turned, " (partners at equal azimuth difference: takes the sample for isotropic)"},
       {key_folded, " (partners at equal size of the azimuth difference: takes the sample for isotropic and mirror symmetric)"}}};
  for (const auto& [key, words] : assumptions) {
    Contrasts more = partner_pairs(subject, key);
    if (2 * pairs.contrasts.size() < more.contrasts.size()) pairs = std::move(more), kind = words;
  }
  double neighbour_scatter = 0;
  std::size_t neighbours = 0;
  if (static_cast<double>(pairs.contrasts.size()) < enough_dof) {
    InterpolatedPairs interpolated = interpolated_partners(subject.datasets, antisymmetric_patterns, pattern_names, pattern_share);
    if (interpolated.set.contrasts.size() > pairs.contrasts.size()) {
      pairs = std::move(interpolated.set);
      neighbour_scatter = interpolated.neighbour_scatter, neighbours = interpolated.neighbours;
      kind = fmt::format(" (partners interpolated{}, takes the sample for isotropic",
                         interpolated.with_model ? " in the ratio to a fitted model" : "");
      if (std::isfinite(interpolated.u_noise))
        kind += fmt::format(": noise {}, interpolation {} of f", percent_text(interpolated.u_noise),
                            percent_text(interpolated.u_interpolation));
      kind += ")";
    }
  }
  if (pairs.contrasts.empty()) {
    check.verdict = Verdict::vacuous;
    check.detail = "no sample has its reciprocal partner, measured or among its neighbours: plan the sweep with reciprocity pairs";
    return check;
  }
  const std::string tested = fmt::format("{} partner pairs{}, {}", pairs.contrasts.size(), kind, departures(pairs));
  judge_symmetry(check, pairs, instrument_scatter(subject, neighbour_scatter, neighbours), subject, options,
                 {"reciprocity", tested, "difference", "chi²/n", ": look for tilt, spot, field or drift first"});
  return check;
}

}  // namespace gonio::fitting
