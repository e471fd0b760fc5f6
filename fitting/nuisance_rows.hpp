// SPDX-License-Identifier: BSD-3-Clause
// The rows of a fit as functions of its nuisance parameters: misalignment of the sample, correlated components.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/misalignment.hpp"
#include "fitting/terms.hpp"

namespace gonio::fitting {

/// One nuisance parameter: an angle of the misalignment [rad], or a component in its standard uncertainties.
struct NuisanceAxis {
  std::string name;
  double bound = 0;                     ///< searched from -bound to bound
  bool with_prior = false;              ///< normal with standard deviation 1: a component
  double unit = 1;                      ///< what 1 is in the result: degrees, or the component's own u
  std::size_t angle = 0;                ///< of a misalignment: which
  std::vector<double> factor_exponent;  ///< of a component: c · u of every row
};

class NuisanceRows {
 public:
  /// Terms and observations must outlive it; `components`: those that may be estimated.
  NuisanceRows(Terms& terms, const Observations& observations, const NuisanceOptions& asked,
               const std::vector<CorrelatedComponent>& components);

  const std::vector<NuisanceAxis>& axes() const noexcept { return axes_; }
  Misalignment misalignment(const std::vector<double>& m) const;
  /// Puts the geometry of the rows, and the factors of their fitted values, in the terms.
  void set(const std::vector<double>& m);

  using Slopes = std::vector<std::vector<std::vector<double>>>;  ///< [parameter][channel][row]
  /// d f̂ / d m_k [1/sr]: central differences in the angles, exact in the components. The terms stand at m before and after.
  Slopes slopes(const std::vector<double>& m, const std::vector<std::vector<double>>& linear, const std::vector<double>& theta);

 private:
  Terms& terms_;
  std::vector<NuisanceAxis> axes_;
  std::vector<GonioAngles> angles_;  ///< of every row, as stated
  Misalignment now_;
};

}  // namespace gonio::fitting
