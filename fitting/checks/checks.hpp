// SPDX-License-Identifier: BSD-3-Clause
// The checks of a BRDF's physics, as statistics (alpha = 1 % per check, Holm over checks, margin 2 % unless told otherwise).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "brdf/observations.hpp"
#include "fitting/checks/check.hpp"

namespace gonio::fitting {

struct CheckOptions {
  double margin = 0.02;
  double alpha = 0.01;
  /// Rotation of the sample for each data set given (degrees); empty: taken from the data's own rotated pairs.
  std::vector<double> rotation_deg;
  std::size_t where = 10;  ///< at most so many places are told
};

/// What is checked: one or several data sets (the same sample rotated), a table as observations, or a model.
struct CheckSubject {
  std::vector<std::shared_ptr<const Dataset>> datasets;
  std::shared_ptr<const Observations> observations;  ///< a table that is not a data set (MERL)
  std::shared_ptr<const Brdf> brdf;                  ///< for energy of tables and models
};

/// f(wi, wo) = f(wo, wi) on the partner pairs of a data set (numerics E): χ² of all differences and directed tests against patterns that
/// change sign under the exchange (cosines, in-plane components, time). Exact partners in the sample's frame; where there are hardly any,
/// partners at equal azimuth difference, or by interpolation of the ratio to a fitted model: both take the sample for isotropic and say so.
/// Effect: root mean square relative difference beyond the noise. A difference that a tilt of the sample's normal explains is called a
/// tilt, and noise that is understated is called that: both warn.
Check check_reciprocity(const CheckSubject& subject, const CheckOptions& options);
/// The same (theta_i, theta_o, phi_o - phi_i) at different azimuths of the sample: several data sets of the rotated sample, or
/// rotated samples inside one. Cochran's Q with harmonic tests: the first tells a tilt or wedge, the second an anisotropic sample. Mirror
/// pairs are no test of isotropy. Effect: relative standard deviation between azimuths beyond the noise.
Check check_isotropy(const CheckSubject& subject, const CheckOptions& options);
/// f is the same on both sides of the plane of incidence. Never `fail` for samples: inside one file an instrument that is off to one side
/// does the same as the material. Effect: root mean square relative difference beyond the noise.
Check check_bilateral(const CheckSubject& subject, const CheckOptions& options);
/// Directional albedo <= 1 for every incidence, each one-sided with Holm over them; `incidences` lists them. Models: the exact bound.
/// Tables: quadrature. Scattered samples: the ratio to a fitted model over the projected hemisphere, with the part no sample covers
/// bounded. Effect: the largest albedo.
Check check_energy(const CheckSubject& subject, const CheckOptions& options);
/// No value is significantly negative: f < -3u against the number noise gives. Effect: the part of the samples beyond that.
Check check_positivity(const CheckSubject& subject, const CheckOptions& options);
/// Along theta_h away from the mirror direction f falls: distance to the nearest falling profile (isotonic regression), with a parametric
/// bootstrap for its distribution. In-plane scans of samples; lines of constant (theta_d, phi_d) of tables and models. Never `fail`: it is
/// no law of physics. Effect: root mean square relative distance beyond the noise.
Check check_monotonicity(const CheckSubject& subject, const CheckOptions& options);
/// At theta_h = 0 an isotropic sample cannot depend on phi_d: what a table in half and difference angles, which cannot fail reciprocity
/// or isotropy, can fail. `skipped` for anything else. Effect: root mean square relative difference.
Check check_mirror_constancy(const CheckSubject& subject, const CheckOptions& options);

struct CheckEntry {
  const char* id;
  Check (*run)(const CheckSubject&, const CheckOptions&);
};

/// Every check: reciprocity, isotropy, bilateral, energy, positivity, monotonicity, mirror_constancy. A new check is one file and one line
/// in the list.
const std::vector<CheckEntry>& check_list();

/// Runs the whole list, leaves out what is skipped, and applies Holm's correction over the checks that have a p-value.
std::vector<Check> run_checks(const CheckSubject& subject, const CheckOptions& options);

}  // namespace gonio::fitting
