// SPDX-License-Identifier: BSD-3-Clause
// From a diffuse part and a lobe to starting values of a target's formula.
#pragma once

#include <vector>

#include "brdf/target_formula.hpp"

namespace gonio::tabulated::targets {

/// Mean over the channels.
double mean(const std::vector<double>& values);
/// √(alpha_x alpha_y) and √(alpha_y/alpha_x): `widths` backwards.
double mean_width(const LobeSummary& summary);
double aspect_of(const LobeSummary& summary);
/// Whether the lobe of the summary is a metal's: brighter at the normal than a dielectric's.
bool is_metal(const LobeSummary& summary);

/// `convert` of the summary, then of summaries with a narrower and a wider lobe, each value put within the bounds of the formula.
/// `convert(summary, metal)` gives the values of one channel; `both` also tries what it gives for the other kind of material.
std::vector<ChannelValues> converted_starts(const LobeSummary& summary, const std::vector<FormulaParameter>& parameters, bool both,
                                            std::vector<double> (*convert)(const LobeSummary& summary, bool metal, std::size_t channel));

/// Burley's `anisotropic` for an aspect, sqrt(1 - 0.9 anisotropic) = min(aspect, 1/aspect); negative where the lobe is longer along y.
double burley_anisotropic(double aspect);

}  // namespace gonio::tabulated::targets
