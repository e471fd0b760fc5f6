// SPDX-License-Identifier: BSD-3-Clause
// Information criteria of a fit.
#include <cmath>
#include <limits>

#include "fitting/fit.hpp"

namespace gonio::fitting {

double FitLikelihood::aicc() const noexcept {
  const double k = static_cast<double>(free_parameters), left = static_cast<double>(n) - k - 1;
  if (!(left > 0)) return std::numeric_limits<double>::infinity();
  return 2 * k - 2 * log_likelihood + 2 * k * (k + 1) / left;
}

double FitLikelihood::bic() const noexcept {
  return static_cast<double>(free_parameters) * std::log(static_cast<double>(n)) - 2 * log_likelihood;
}

}  // namespace gonio::fitting
