// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "fitting/checks/by_evaluation.hpp"
#include "fitting/checks/checks.hpp"
#include "fitting/checks/equality.hpp"
#include "fitting/checks/sample_places.hpp"

namespace gonio::fitting {
namespace {

constexpr std::array<const char*, 4> pattern_names{"once per turn (a tilt)", "once per turn (a tilt)",
                                                   "twice per turn (an anisotropic sample)", "twice per turn (an anisotropic sample)"};

std::vector<double> harmonics(double azimuth) {
  return {std::cos(azimuth), std::sin(azimuth), std::cos(2 * azimuth), std::sin(2 * azimuth)};
}

/// One member of a group: samples of one data set at one azimuth of the sample.
struct Azimuth {
  std::size_t dataset = 0;
  double radians = 0;
  std::vector<std::size_t> samples;
};

double azimuth_of(const GonioAngles& angles) {
  return std::abs(angles.theta_i.sin()) < same_direction_rad ? angles.phi_o.radians() : angles.phi_i.radians();
}

/// Inside one data set: the same pose relative to the plane of incidence, at different azimuths.
std::vector<std::vector<Azimuth>> rotated_inside(const Dataset& dataset) {
  Places turned, exact;
  std::vector<std::map<std::size_t, Azimuth>> groups;
  for (std::size_t k = 0; k < dataset.size(); ++k) {
    const std::size_t group = turned.add(key_turned(dataset.angles[k])), place = exact.add(key_of(dataset.angles[k]));
    if (group == groups.size()) groups.emplace_back();
    Azimuth& member = groups[group][place];
    member.radians = azimuth_of(dataset.angles[k]);
    member.samples.push_back(k);
  }
  std::vector<std::vector<Azimuth>> out;
  for (const auto& group : groups) {
    out.emplace_back();
    for (const auto& [place, member] : group) out.back().push_back(member);
  }
  return out;
}

/// Several data sets of the same sample, rotated between them: the same pose of the bench.
std::vector<std::vector<Azimuth>> rotated_between(const CheckSubject& subject, const CheckOptions& options) {
  Places exact;
  std::vector<std::map<std::size_t, Azimuth>> groups;
  for (std::size_t d = 0; d < subject.datasets.size(); ++d)
    for (std::size_t k = 0; k < subject.datasets[d]->size(); ++k) {
      const std::size_t group = exact.add(key_of(subject.datasets[d]->angles[k]));
      if (group == groups.size()) groups.emplace_back();
      Azimuth& member = groups[group][d];
      member.dataset = d;
      member.radians = d < options.rotation_deg.size() ? options.rotation_deg[d] * std::numbers::pi / 180 : 0;
      member.samples.push_back(k);
    }
  std::vector<std::vector<Azimuth>> out;
  for (const auto& group : groups) {
    out.emplace_back();
    for (const auto& [place, member] : group) out.back().push_back(member);
  }
  return out;
}

/// The groups channel by channel. Shared components are taken as independent between data sets: each has its own reference.
std::vector<EqualGroup> equal_groups(const CheckSubject& subject, const std::vector<std::vector<Azimuth>>& places) {
  std::vector<std::size_t> first(subject.datasets.size() + 1, 0);
  for (std::size_t d = 0; d < subject.datasets.size(); ++d) first[d + 1] = first[d] + subject.datasets[d]->correlated.size();
  std::vector<EqualGroup> groups;
  for (const auto& place : places) {
    if (place.size() < 2) continue;
    for (std::size_t c = 0; c < subject.datasets[0]->channels.size(); ++c) {
      EqualGroup group;
      for (const Azimuth& azimuth : place) {
        const Dataset& dataset = *subject.datasets[azimuth.dataset];
        if (c >= dataset.channels.size()) continue;
        const auto mean = mean_of(dataset, c, azimuth.samples);
        if (!mean) continue;
        EqualMember member{mean->f, mean->u, std::vector<double>(first.back(), 0.0), harmonics(azimuth.radians)};
        std::copy(mean->shared.begin(), mean->shared.end(), member.shared.begin() + static_cast<std::ptrdiff_t>(first[azimuth.dataset]));
        group.push_back(std::move(member));
      }
      if (group.size() > 1) groups.push_back(std::move(group));
    }
  }
  return groups;
}

}  // namespace

Check check_isotropy(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "isotropy";
  check.threshold = options.margin;
  if (holds_by_construction(subject, &Symmetry::isotropic)) {
    check.verdict = Verdict::vacuous;
    check.detail = "holds by construction of the data or the model, so there is nothing to test";
    return check;
  }
  if (subject.datasets.empty()) {
    describe_by_evaluation(check, subject, [](const GonioAngles& angles, double number) {
      const Angle turn = radians(2 * std::numbers::pi * number);
      return GonioAngles{angles.theta_i, angles.phi_i + turn, angles.theta_o, angles.phi_o + turn};
    });
    return check;
  }
  const bool several = subject.datasets.size() > 1;
  const auto groups = equal_groups(subject, several ? rotated_between(subject, options) : rotated_inside(*subject.datasets[0]));
  if (groups.empty()) {
    check.verdict = Verdict::vacuous;
    check.detail = "no pose was measured at more than one azimuth of the sample: plan the sweep with rotations";
    return check;
  }
  const EqualityTest test = test_equality(groups, options.margin, options.alpha, 1);
  judge_equality(check, test, options);
  if (!test.has_uncertainty) {
    check.detail =
        fmt::format("{} poses vary by {:.2g} % between azimuths of the sample, but without uncertainties nothing tells this from noise",
                    test.groups, 100 * test.effect);
    return check;
  }
  check.detail = fmt::format("{} poses: variation between azimuths beyond noise {:.2g} % ± {:.2g} %, Q/dof {:.3g}", test.groups,
                             100 * test.effect, 100 * test.u_effect, test.chi2 / test.dof);
  if (check.verdict == Verdict::vacuous) check.detail += fmt::format("; the data cannot tell within {:.2g} %", 100 * options.margin);
  if (test.strongest >= 0) check.detail += fmt::format("; it varies {}", pattern_names[static_cast<std::size_t>(test.strongest)]);
  return check;
}

}  // namespace gonio::fitting
