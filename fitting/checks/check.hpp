// SPDX-License-Identifier: BSD-3-Clause
// The one result type of every check, and the rule that turns a statistic into a verdict.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "brdf/coordinates.hpp"

namespace gonio::fitting {

/// pass: equivalent within the margin. warn: significant only. fail: significant and beyond the margin.
/// vacuous: the data cannot tell, with the reason. skipped: not asked for or not applicable.
enum class Verdict { pass, warn, fail, vacuous, skipped };
const char* name(Verdict verdict) noexcept;

/// A place where the property does not hold: one partner pair, pose or sample.
struct Place {
  GonioAngles angles;  ///< of the first member, as the data name them
  std::string channel;
  std::optional<double> ratio;         ///< first over second value, or largest over smallest where there are more
  std::optional<double> z;             ///< difference in standard uncertainties; none without uncertainties
  std::optional<double> p_holm, p_bh;  ///< adjusted for all the places tested: family-wise and false discovery rate
};

/// A test of one degree of freedom against a pattern of known shape.
struct DirectedTest {
  std::string pattern;
  double amplitude = 0, u = 0;  ///< rms relative size of the fitted pattern, signed, and its standard uncertainty
  double z = 0, p_value = 1;    ///< two-sided, of this test alone
};

/// The directional albedo at one incidence and channel.
struct IncidenceAlbedo {
  double theta_i_deg = 0, phi_i_deg = 0;
  std::string channel;
  double albedo = 0;         ///< of the part that samples cover
  double u_noise = 0;        ///< from the samples' own uncertainties
  double u_quadrature = 0;   ///< from the rule of integration
  double u_scale = 0;        ///< from the components that samples share
  double covered = 0;        ///< part of the projected hemisphere that samples cover, 0 … 1
  double missing_bound = 0;  ///< what the rest could add: the albedo lies in [albedo, albedo + missing_bound]
};

struct Check {
  std::string id;  ///< reciprocity, isotropy, energy, positivity, energy_bound, ...
  Verdict verdict = Verdict::skipped;
  std::optional<double> statistic, p_value;  ///< none where the check is no test of a hypothesis
  std::optional<double> effect;              ///< size of the effect in `unit`
  std::optional<double> u_effect;            ///< its standard uncertainty
  std::optional<double> effect_upper;        ///< upper confidence limit of the effect, held against `threshold` for `pass`
  std::string unit;
  std::optional<double> threshold;  ///< margin or limit the effect is held against
  std::size_t n = 0;                ///< what was tested: pairs, incidences, samples
  std::string detail;               ///< one sentence a person understands
  std::vector<DirectedTest> directed;
  std::vector<Place> where;  ///< the places that stand out, the least likely first
  std::vector<IncidenceAlbedo> incidences;
};

/// A relative number for a sentence: `0.95 %`, `110 %`, `less than 1e-6 %`; `unknown` for NaN.
std::string percent_text(double relative);

/// The rule of every test: significant and beyond the margin fails, significant alone warns; not significant passes only if the upper
/// confidence limit of the effect lies within the margin too (equivalence), else the data cannot tell.
Verdict judge(bool significant, double effect, double effect_upper, double margin) noexcept;

}  // namespace gonio::fitting
