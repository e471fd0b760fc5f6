// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/determined.hpp"

#include <cmath>
#include <optional>

namespace gonio::fitting {
namespace {

/// Normal incidence, observed from the normal: the default geometry.
constexpr std::size_t one = 1;

/// The basis functions in the peak.
std::vector<double> peak_basis(const ModelKernel& kernel, const std::vector<double>& theta) {
  const LobeGeometry peak;
  std::vector<double> out(kernel.linear);
  kernel.basis(std::span(&peak, one), theta.data(), out.data(), one);
  return out;
}

/// The one linear parameter of a term's lobe that counts in its peak.
std::optional<std::size_t> peak_parameter(const ModelTerm& term, const std::vector<double>& basis) {
  std::optional<std::size_t> found;
  // The diffuse part of the first term is no lobe.
  for (std::size_t k = term.linear + (term.first_basis == 0 ? 1 : 0); k < term.linear + term.model->linear_count - term.first_basis; ++k) {
    if (!(basis[k] > 0)) continue;
    if (found) return std::nullopt;
    found = k;
  }
  return found;
}

bool two_sided(const Estimate& estimate) { return estimate.kind == IntervalKind::interval || estimate.kind == IntervalKind::fixed; }

/// Derivatives of x_k · basis_k in the peak by every parameter.
std::vector<double> gradient(const ModelKernel& kernel, const Solution& solution, const ParameterPlaces& places, std::size_t channel,
                             std::size_t k) {
  const LobeGeometry peak;
  std::vector<double> basis(kernel.linear), slopes(kernel.linear * kernel.nonlinear), out(places.size(), 0.0);
  kernel.basis_and_slopes(std::span(&peak, one), solution.theta.data(), basis.data(), slopes.data(), one);
  out[places.of_linear(channel, k)] = basis[k];
  for (std::size_t j = 0; j < kernel.nonlinear; ++j)
    out[places.of_nonlinear(j)] = solution.linear[channel][k] * slopes[j * kernel.linear + k];
  return out;
}

}  // namespace

void add_determined(Solution& solution, const Profile& profile, const SearchSpace& space, const LineIntervals* line, const About& about) {
  const ModelKernel& kernel = profile.terms().kernel;
  const std::vector<double> basis = peak_basis(kernel, solution.theta);
  for (std::size_t t = 0; t < kernel.info->terms.size(); ++t) {
    const ModelTerm& term = kernel.info->terms[t];
    const auto k = peak_parameter(term, basis);
    if (!k || term.model->nonlinear_count() == 0) continue;
    bool shape_known = true;
    for (std::size_t j = 0; j < term.model->nonlinear_count(); ++j)
      shape_known = shape_known && two_sided(solution.nonlinear_estimate[term.nonlinear + j]);
    for (std::size_t c = 0; c < solution.linear.size(); ++c) {
      const double value = solution.linear[c][*k] * basis[*k];
      if ((shape_known && two_sided(solution.linear_estimate[c][*k])) || !(value > 0)) continue;
      const std::vector<double> slopes = gradient(kernel, solution, about.places, c, *k);
      const auto variance = variance_of(about.linearisation, about.places, space, about.scale, slopes);
      double shared = 0;
      for (const std::vector<double>& move : about.moves) {
        double effect = 0;
        for (std::size_t p = 0; p < slopes.size(); ++p) effect += slopes[p] * move[p];
        shared += effect * effect;
      }
      Reach reach;
      if (line)
        reach = line->linear(c, *k, [&](const std::vector<double>& theta) { return peak_basis(kernel, theta)[*k]; });
      else if (variance)
        reach = {value - about.quantile * std::sqrt(*variance), value + about.quantile * std::sqrt(*variance)};
      if (!(reach.low > 0) || !std::isfinite(reach.high)) continue;
      Combination found{c, t, {}};
      found.estimate.value = value;
      found.estimate.kind = IntervalKind::interval;
      found.estimate.low = value - std::hypot(value - reach.low, about.quantile * std::sqrt(shared));
      found.estimate.high = value + std::hypot(reach.high - value, about.quantile * std::sqrt(shared));
      if (variance && *variance + shared > 0) found.estimate.sigma = std::sqrt(*variance + shared);
      solution.determined.push_back(found);
    }
  }
}

}  // namespace gonio::fitting
