// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "fitting/checks/checks.hpp"
#include "fitting/checks/table_symmetry.hpp"

namespace gonio::fitting {
namespace {

constexpr double hardly_tilted_deg = 1e-6;  // theta_h at which phi_d still means something
constexpr int azimuths = 36;                // of phi_d, 5° apart over the stored half turn: neighbours lie in different cells

}  // namespace

Check check_mirror_constancy(const CheckSubject& subject, const CheckOptions& options) {
  Check check;
  check.id = "mirror_constancy";
  check.unit = "relative";
  check.threshold = options.margin;
  const bool model = dynamic_cast<const AnalyticBrdf*>(subject.brdf.get()) != nullptr;
  const Symmetry symmetry = subject.brdf ? subject.brdf->symmetry() : Symmetry{};
  if (!subject.datasets.empty() || !subject.brdf || model || !symmetry.isotropic || !symmetry.reciprocal) {
    check.detail = "only for isotropic tables in half and difference angles";
    return check;
  }
  std::vector<TableDifference> differences;
  const std::size_t channels = subject.brdf->channels().size();
  for (double theta_d = 2.5; theta_d <= 80; theta_d += 2.5) {
    std::vector<std::vector<double>> f;
    std::vector<GonioAngles> angles;
    for (int k = 0; k < azimuths; ++k) {
      const DirectionPair pair =
          directions({degrees(hardly_tilted_deg), degrees(0), degrees(theta_d), degrees(180. * (k + 0.5) / azimuths)});
      f.push_back(subject.brdf->eval(pair.wi, pair.wo));
      angles.push_back(gonio_angles(pair.wi, pair.wo));
    }
    for (std::size_t c = 0; c < channels; ++c) {
      double mean = 0, n = 0;
      for (const auto& values : f)
        if (std::isfinite(values[c])) mean += values[c], n += 1;
      mean /= n;
      if (!(n > 1 && mean > 0)) continue;
      for (std::size_t k = 0; k < f.size(); ++k) {
        const double here = f[k][c] / mean, nearby = f[(k + 1) % f.size()][c] / mean;
        if (std::isfinite(here) && std::isfinite(nearby))
          differences.push_back({here - 1, nearby - 1, std::pow(std::cos(theta_d * std::numbers::pi / 180), 2), angles[k], c, here});
      }
    }
  }
  judge_table(check, differences, fmt::format("{} values at theta_h = 0 against their mean over phi_d", differences.size()), subject,
              options);
  return check;
}

}  // namespace gonio::fitting
