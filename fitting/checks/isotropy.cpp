// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/contrasts.hpp"
#include "fitting/checks/paired_places.hpp"
#include "fitting/checks/repeatability.hpp"
#include "fitting/checks/symmetry_verdict.hpp"
#include "fitting/checks/table_symmetry.hpp"

namespace gonio::fitting {
namespace {

std::vector<double> harmonics(double azimuth) {
  return {std::cos(azimuth), std::sin(azimuth), std::cos(2 * azimuth), std::sin(2 * azimuth)};
}

/// One member of a pose: samples of one data set at one azimuth of the sample.
struct Azimuth {
  std::size_t dataset = 0;
  double radians = 0;
  std::vector<std::size_t> samples;
};
/// The azimuths at which one pose relative to the plane of incidence was measured.
using Pose = std::vector<Azimuth>;

double azimuth_of(const GonioAngles& angles) {
  return std::abs(angles.theta_i.sin()) < same_direction_rad ? angles.phi_o.radians() : angles.phi_i.radians();
}

/// Inside one data set: the same pose relative to the plane of incidence, at different azimuths.
std::vector<Pose> rotated_inside(const Dataset& dataset) {
  Places turned, exact;
  std::vector<std::map<std::size_t, Azimuth>> poses;
  for (std::size_t k = 0; k < dataset.size(); ++k) {
    const std::size_t pose = turned.add(key_turned(dataset.angles[k])), place = exact.add(key_of(dataset.angles[k]));
    if (pose == poses.size()) poses.emplace_back();
    Azimuth& member = poses[pose][place];
    member.radians = azimuth_of(dataset.angles[k]);
    member.samples.push_back(k);
  }
  std::vector<Pose> out;
  for (const auto& pose : poses) {
    out.emplace_back();
    for (const auto& [place, member] : pose) out.back().push_back(member);
  }
  return out;
}

/// Several data sets of the same sample, rotated between them: the same pose of the bench.
std::vector<Pose> rotated_between(const CheckSubject& subject, const CheckOptions& options) {
  Places exact;
  std::vector<std::map<std::size_t, Azimuth>> poses;
  for (std::size_t d = 0; d < subject.datasets.size(); ++d)
    for (std::size_t k = 0; k < subject.datasets[d]->size(); ++k) {
      const std::size_t pose = exact.add(key_of(subject.datasets[d]->angles[k]));
      if (pose == poses.size()) poses.emplace_back();
      Azimuth& member = poses[pose][d];
      member.dataset = d;
      member.radians = d < options.rotation_deg.size() ? options.rotation_deg[d] * std::numbers::pi / 180 : 0;
      member.samples.push_back(k);
    }
  std::vector<Pose> out;
  for (const auto& pose : poses) {
    out.emplace_back();
    for (const auto& [dataset, member] : pose) out.back().push_back(member);
  }
  return out;
}

/// The readings of one pose and channel as contrasts: each against the mean of those before it, so that they are independent and their
/// χ² is Cochran's Q. All take the mean variance where they differ little, because a u made from its own reading favours low readings
/// (numerics C13).
void add_contrasts(std::vector<Reading> readings, const std::vector<double>& azimuths, std::size_t place, Contrasts& out) {
  double mean = 0, variance = 0, least = INFINITY, most = 0;
  const auto n = static_cast<double>(readings.size());
  for (const Reading& reading : readings) {
    const double u2 = reading.u * reading.u;
    mean += reading.f / n, variance += u2 / n, least = std::min(least, u2), most = std::max(most, u2);
  }
  const bool known = std::isfinite(variance);
  if (!known || most < 4 * least)
    for (Reading& reading : readings) reading.u = known ? std::sqrt(variance) : std::nan("");
  std::vector<Contrast::Term> before;
  std::vector<double> pattern_before(harmonics(0).size(), 0.0);
  double total = 0;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const auto pattern = harmonics(azimuths[k]);
    const std::size_t here = out.readings.size();
    const double weight = known ? 1 / (readings[k].u * readings[k].u) : 1;
    if (k > 0) {
      Contrast contrast;
      contrast.mean = mean;
      contrast.place = place;
      contrast.terms = {{here, 1}};
      double square = 1;
      for (const auto& [reading, w] : before) {
        contrast.terms.push_back({reading, -w / total});
        square += w * w / (total * total);
      }
      contrast.scale = std::abs(mean) * std::sqrt(square);
      for (std::size_t p = 0; p < pattern.size(); ++p) contrast.pattern.push_back(mean * (pattern[p] - pattern_before[p] / total));
      out.contrasts.push_back(std::move(contrast));
    }
    before.push_back({here, weight});
    total += weight;
    for (std::size_t p = 0; p < pattern.size(); ++p) pattern_before[p] += weight * pattern[p];
    out.readings.push_back(std::move(readings[k]));
  }
}

Contrasts between_azimuths(const CheckSubject& subject, const CheckOptions& options) {
  const bool several = subject.datasets.size() > 1;
  const auto poses = several ? rotated_between(subject, options) : rotated_inside(*subject.datasets[0]);
  const auto first = first_components(subject.datasets);
  Contrasts out;
  out.pattern_names = {"the azimuth once per turn (cosine: a tilt or wedge)", "the azimuth once per turn (sine: a tilt or wedge)",
                       "the azimuth twice per turn (cosine: an anisotropic sample)",
                       "the azimuth twice per turn (sine: an anisotropic sample)"};
  out.pattern_share = {0.1, 0.1, 0.2, 0.2};
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (poses[p].size() < 2) continue;
    for (std::size_t c = 0; c < subject.datasets[0]->channels.size(); ++c) {
      std::vector<Reading> readings;
      std::vector<double> azimuths;
      for (const Azimuth& azimuth : poses[p]) {
        const Dataset& dataset = *subject.datasets[azimuth.dataset];
        if (c >= dataset.channels.size()) continue;
        auto reading = reading_of(dataset, c, azimuth.samples, first[azimuth.dataset], first.back());
        if (!reading) continue;
        // A sample turned by r sees the bench turned by -r.
        if (several) reading->angles.phi_i = reading->angles.phi_i - radians(azimuth.radians);
        if (several) reading->angles.phi_o = reading->angles.phi_o - radians(azimuth.radians);
        readings.push_back(std::move(*reading));
        azimuths.push_back(azimuth.radians);
      }
      if (readings.size() > 1) add_contrasts(std::move(readings), azimuths, p, out);
    }
  }
  return out;
}

std::size_t pose_count(const Contrasts& set) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < set.contrasts.size(); ++k) {
    const auto key = [&](std::size_t r) {
      return std::pair(set.contrasts[r].place, set.readings[set.contrasts[r].terms[0].reading].channel);
    };
    count += k == 0 || key(k) != key(k - 1);
  }
  return count;
}

}  // namespace

Check check_isotropy(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "isotropy";
  check.unit = "relative";
  check.threshold = options.margin;
  if (holds_by_construction(subject, &Symmetry::isotropic)) {
    check.verdict = Verdict::vacuous;
    check.detail = "cannot fail: it holds by construction of the data or the model, so nothing was tested";
    return check;
  }
  if (subject.datasets.empty()) {
    judge_by_evaluation(check, subject, options, [](const GonioAngles& angles, double number) {
      const Angle turn = radians(2 * std::numbers::pi * number);
      return GonioAngles{angles.theta_i, angles.phi_i + turn, angles.theta_o, angles.phi_o + turn};
    });
    return check;
  }
  const Contrasts set = between_azimuths(subject, options);
  const std::size_t poses = pose_count(set);
  if (poses == 0) {
    check.verdict = Verdict::vacuous;
    check.detail = "no pose was measured at more than one azimuth of the sample: plan the sweep with rotations";
    return check;
  }
  judge_symmetry(check, set, repeated_readings(subject.datasets), subject, options,
                 {"isotropy", fmt::format("{} poses", poses), "variation between azimuths", "Q/dof", ""});
  check.n = poses;
  return check;
}

}  // namespace gonio::fitting
