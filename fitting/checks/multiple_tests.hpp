// SPDX-License-Identifier: BSD-3-Clause
// P-values adjusted for how many hypotheses were tested.
#pragma once

#include <cstddef>
#include <vector>

#include "fitting/checks/check.hpp"

namespace gonio::fitting {

/// Holm's step-down adjustment (Scand. J. Statist. 6, 1979): rejecting where the adjusted value is below alpha makes any false rejection
/// at all less likely than alpha, however the tests depend on each other. In the order given.
std::vector<double> holm(const std::vector<double>& p);
/// Benjamini and Hochberg's step-up adjustment (J. R. Statist. Soc. B 57, 1995): rejecting below q keeps the expected part of false
/// ones among the rejected below q, for independent or positively dependent tests. Never above Holm's. In the order given.
std::vector<double> benjamini_hochberg(const std::vector<double>& p);

/// Fills the adjusted p-values of `places` from their own (`p[k]` belongs to `places[k]`), keeps those that Benjamini and Hochberg reject
/// at `alpha` and sorts them, the least likely first and among equals by |z|; then keeps at most `most`.
/// `rejected_holm` and `rejected_bh` count before the cut.
struct Located {
  std::vector<Place> places;
  std::size_t rejected_holm = 0, rejected_bh = 0;
};
Located locate(std::vector<Place> places, const std::vector<double>& p, double alpha, std::size_t most);

}  // namespace gonio::fitting
