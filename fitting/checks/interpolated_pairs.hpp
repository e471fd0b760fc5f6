// SPDX-License-Identifier: BSD-3-Clause
// Reciprocal partners that were not measured, interpolated from the samples around them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fitting/checks/paired_places.hpp"

namespace gonio::fitting {

struct InterpolatedPairs {
  Contrasts set;
  /// rms over the pairs, relative to the mean: uncertainty of the partner's value from the noise of the samples it is made of, and from
  /// the interpolation itself.
  double u_noise = 0, u_interpolation = 0;
  /// Median |difference| between a sample and the value its neighbours at other incidences give, relative: noise and interpolation of data
  /// without u.
  double neighbour_scatter = 0;
  std::size_t neighbours = 0;  ///< samples it comes from
  bool with_model = false;     ///< the ratio to a fitted model was interpolated, not f itself
};

/// f(sample) - f̂(its partner) for every sample whose partner lies among the others. f̂ is the local interpolation of the ratio of the data
/// to the fitted model, times the model: smooth even where f is not (numerics E). Its noise follows from the weights. Its interpolation
/// error is estimated from samples against their neighbours at other incidences: what they differ by beyond the noise, in groups of equal
/// theta_h.
InterpolatedPairs interpolated_partners(const std::vector<std::shared_ptr<const Dataset>>& datasets, const Patterns& patterns,
                                        const std::vector<std::string>& pattern_names, const std::vector<double>& pattern_share);

}  // namespace gonio::fitting
