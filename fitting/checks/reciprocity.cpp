// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/contrasts.hpp"
#include "fitting/checks/paired_places.hpp"
#include "fitting/checks/repeatability.hpp"
#include "fitting/checks/symmetry_verdict.hpp"
#include "fitting/checks/table_symmetry.hpp"

namespace gonio::fitting {
namespace {

Contrasts partner_pairs(const CheckSubject& subject, bool turned) {
  Contrasts pairs;
  pairs.pattern_names = {"the difference of the cosines", "the x component", "the y component", "time"};
  // The cosines are what field, spot and cosine errors go with: they get most of the significance (power at 0.1 % asymmetry).
  pairs.pattern_share = {0.7, 0.05, 0.05, 0.1};
  const PlaceSymmetry symmetry{turned ? key_turned : key_of, exchanged};
  add_pairs(
      subject.datasets, symmetry,
      [](const Dataset& dataset, std::size_t sample) {
        const Direction wi = dataset.angles[sample].wi(), wo = dataset.angles[sample].wo();
        return std::vector<double>{wi.z() - wo.z(), wi.x() - wo.x(), wi.y() - wo.y(), part_of_time(dataset, sample)};
      },
      pairs);
  return pairs;
}

/// The same statistic for pairs that are no partners, a negative control (Capderou and Michel): the median |difference| over the mean.
double median_departure(const Contrasts& pairs, std::size_t shift) {
  std::vector<double> departure;
  const std::size_t n = pairs.contrasts.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double one = pairs.readings[pairs.contrasts[k].terms[0].reading].f;
    const double other = pairs.readings[pairs.contrasts[(k + shift) % n].terms[1].reading].f;
    if (one + other > 0) departure.push_back(2 * std::abs(one - other) / (one + other));
  }
  if (departure.empty()) return 0;
  const auto middle = departure.begin() + static_cast<std::ptrdiff_t>(departure.size() / 2);
  std::nth_element(departure.begin(), middle, departure.end());
  return *middle;
}

/// Without stated uncertainties: mirror pairs differ by the instrument or by the sample, but never by reciprocity; repeats by noise alone.
std::optional<Repeatability> instrument_scatter(const CheckSubject& subject) {
  if (std::any_of(subject.datasets.begin(), subject.datasets.end(), [](const auto& d) { return d->has_uncertainty(); }))
    return std::nullopt;
  auto scatter = repeated_readings(subject.datasets);
  if (scatter) scatter->relative *= std::numbers::sqrt2;  // of a difference
  const MedianEffect mirror = median_effect(mirror_pairs(subject.datasets), 0.5);
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
    check.detail = "holds by construction of the data or the model, so there is nothing to test";
    return check;
  }
  if (subject.datasets.empty()) {
    describe_by_evaluation(check, subject, [](const GonioAngles& angles, double) { return exchanged(angles); });
    return check;
  }
  Contrasts pairs = partner_pairs(subject, false);
  // A stage that never turns has exact partners on one side of the plane of incidence only.
  Contrasts turned_pairs = partner_pairs(subject, true);
  const bool turned = 2 * pairs.contrasts.size() < turned_pairs.contrasts.size();
  if (turned) pairs = std::move(turned_pairs);
  if (pairs.contrasts.empty()) {
    check.verdict = Verdict::vacuous;
    check.detail = "no sample has its reciprocal partner: plan the sweep with reciprocity pairs";
    return check;
  }
  const std::string_view assumption = turned ? " (partners at equal azimuth difference: takes the sample for isotropic)" : "";
  const std::string tested =
      fmt::format("{} partner pairs{}, median |difference| {:.2g} % (arbitrary pairs {:.2g} %)", pairs.contrasts.size(), assumption,
                  100 * median_departure(pairs, 0), 100 * median_departure(pairs, pairs.contrasts.size() / 2));
  judge_symmetry(check, pairs, instrument_scatter(subject), subject, options,
                 {"reciprocity", tested, "difference", "chi²/n", ": look for tilt, spot, field or drift first"});
  return check;
}

}  // namespace gonio::fitting
