// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "fitting/checks/by_evaluation.hpp"
#include "fitting/checks/checks.hpp"
#include "fitting/checks/equality.hpp"
#include "fitting/checks/sample_places.hpp"

namespace gonio::fitting {
namespace {

constexpr std::array<const char*, 4> pattern_names{"the difference of the cosines", "the x component", "the y component", "time"};

struct PlacedSamples {
  GonioAngles angles;
  std::vector<std::size_t> samples;
};

std::vector<double> patterns(const Dataset& dataset, const PlacedSamples& place) {
  const Direction wi = place.angles.wi(), wo = place.angles.wo();
  std::vector<double> out{wi.z() - wo.z(), wi.x() - wo.x(), wi.y() - wo.y(), 0};
  const auto time = dataset.extra.find("time_s");
  if (time != dataset.extra.end()) {
    const auto [first, last] = std::minmax_element(time->second.begin(), time->second.end());
    if (*last > *first) out[3] = (time->second[place.samples.front()] - *first) / (*last - *first);
  }
  return out;
}

/// Partner pairs of every channel. `turned`: azimuths count only by their difference.
std::vector<EqualGroup> partner_pairs(const Dataset& dataset, bool turned) {
  const auto key = [turned](const GonioAngles& angles) { return turned ? key_turned(angles) : key_of(angles); };
  Places index;
  std::vector<PlacedSamples> places;
  for (std::size_t k = 0; k < dataset.size(); ++k) {
    const std::size_t place = index.add(key(dataset.angles[k]));
    if (place == places.size()) places.push_back({dataset.angles[k], {}});
    places[place].samples.push_back(k);
  }
  std::vector<EqualGroup> pairs;
  for (std::size_t a = 0; a < places.size(); ++a) {
    const auto b = index.find(key(exchanged(places[a].angles)));
    if (!b || *b <= a) continue;
    for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
      const auto first = mean_of(dataset, c, places[a].samples), second = mean_of(dataset, c, places[*b].samples);
      if (!first || !second) continue;
      pairs.push_back({{first->f, first->u, first->shared, patterns(dataset, places[a])},
                       {second->f, second->u, second->shared, patterns(dataset, places[*b])}});
    }
  }
  return pairs;
}

}  // namespace

Check check_reciprocity(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "reciprocity";
  check.threshold = options.margin;
  if (holds_by_construction(subject, &Symmetry::reciprocal)) {
    check.verdict = Verdict::vacuous;
    check.detail = "holds by construction of the data or the model, so there is nothing to test";
    return check;
  }
  if (subject.datasets.empty()) {
    describe_by_evaluation(check, subject, [](const GonioAngles& angles, double) { return exchanged(angles); });
    return check;
  }
  std::vector<EqualGroup> pairs;
  bool turned = false;
  for (const bool turn : {false, true}) {
    for (const auto& dataset : subject.datasets)
      for (EqualGroup& pair : partner_pairs(*dataset, turn)) {
        // Shared components belong to their own data set only; pairs never cross data sets, so equal lengths are all that is needed.
        pairs.push_back(std::move(pair));
      }
    turned = turn;
    if (!pairs.empty()) break;
  }
  std::size_t components = 0;
  for (const EqualGroup& pair : pairs) components = std::max(components, pair[0].shared.size());
  for (EqualGroup& pair : pairs)
    for (EqualMember& member : pair) member.shared.resize(components);
  if (pairs.empty()) {
    check.verdict = Verdict::vacuous;
    check.detail = "no sample has its reciprocal partner: plan the sweep with reciprocity pairs";
    return check;
  }
  const EqualityTest test = test_equality(pairs, options.margin, options.alpha, std::sqrt(2.0));
  judge_equality(check, test, options);
  const std::string_view assumption = turned ? " (partners at equal azimuth difference: takes the sample for isotropic)" : "";
  if (!test.has_uncertainty) {
    check.detail = fmt::format("{} partner pairs{} differ by {:.2g} % (rms), but without uncertainties nothing tells this from noise",
                               test.groups, assumption, 100 * test.effect);
    return check;
  }
  check.detail = fmt::format("{} partner pairs{}: difference beyond noise {:.2g} % ± {:.2g} %, chi²/n {:.3g}", test.groups, assumption,
                             100 * test.effect, 100 * test.u_effect, test.chi2 / test.dof);
  if (check.verdict == Verdict::vacuous) check.detail += fmt::format("; the data cannot tell within {:.2g} %", 100 * options.margin);
  if (test.strongest >= 0)
    check.detail += fmt::format("; it goes with {}: look for tilt, spot, field or drift first",
                                pattern_names[static_cast<std::size_t>(test.strongest)]);
  return check;
}

}  // namespace gonio::fitting
