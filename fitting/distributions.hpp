// SPDX-License-Identifier: BSD-3-Clause
// The probability distributions that intervals and checks need.
#pragma once

#include <cstddef>

namespace gonio::fitting {

/// P(Z > z) of the standard normal distribution, from erfc: full relative precision in the far tail.
double normal_upper_tail(double z) noexcept;
/// z with P(Z > z) = p, 0 < p < 1.
double normal_upper_quantile(double p) noexcept;
/// P(X > chi2) for `dof` degrees of freedom, the regularised incomplete gamma function Q(dof/2, chi2/2) (Abramowitz & Stegun 26.4.19):
/// series below dof + 2, continued fraction (Lentz) above. 1 for chi2 <= 0.
double chi2_upper_tail(double chi2, double dof) noexcept;
/// t with P(|T| < t) = confidence for Student's distribution with `dof` >= 1 degrees of freedom. Tends to the normal quantile.
double student_two_sided_quantile(double confidence, double dof) noexcept;
/// P(K >= k) for a binomial count of n trials with probability p each; 1 for k = 0.
double binomial_upper_tail(std::size_t k, std::size_t n, double p) noexcept;
/// The probability above which `k` successes in `n` trials are less likely than `alpha` (Clopper and Pearson 1934, one-sided upper end).
double binomial_upper_limit(std::size_t k, std::size_t n, double alpha) noexcept;

}  // namespace gonio::fitting
