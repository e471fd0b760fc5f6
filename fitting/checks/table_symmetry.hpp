// SPDX-License-Identifier: BSD-3-Clause
// Symmetries of a model or table that can be evaluated anywhere but carries no uncertainty.
#pragma once

#include <functional>

#include "fitting/checks/checks.hpp"

namespace gonio::fitting {

/// Whether everything in the subject has the property by construction.
bool holds_by_construction(const CheckSubject& subject, bool Symmetry::*property);

/// Effect only, and the verdict `vacuous`: the rms relative difference of f at fixed, evenly spread pairs of directions and at their
/// images (`image` gets the angles and a number in [0, 1)). Nothing tells a table's noise from its asymmetry.
void describe_by_evaluation(Check& check, const CheckSubject& subject, const std::function<GonioAngles(const GonioAngles&, double)>& image);

/// The k-th of a fixed sequence of pairs, even in solid angle up to 80° (additive recurrence of the plastic-number family).
GonioAngles spread_pair(std::size_t k, double& number);

}  // namespace gonio::fitting
