// SPDX-License-Identifier: BSD-3-Clause
// The test behind reciprocity, isotropy and bilateral symmetry: combinations of readings that should be zero.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "brdf/coordinates.hpp"
#include "fitting/checks/check.hpp"

namespace gonio::fitting {

/// One value of a data set, or the mean of several at the same place.
struct Reading {
  double f = 0, u = 0;         ///< 1/sr; u independent of every other reading, NaN: unknown
  std::vector<double> shared;  ///< effect on f of one standard deviation of every shared component, the same order in every reading
  GonioAngles angles;          ///< in the frame of the sample
  std::size_t channel = 0;
};

/// c = Σ weight · f, expected zero. Its variance is Σ weight² u² + u_interpolation²; with an effect of relative size e it has the mean
/// square variance + e² scale².
struct Contrast {
  struct Term {
    std::size_t reading;
    double weight;
  };
  std::vector<Term> terms;
  double mean = 0, scale = 0;   ///< 1/sr: the mean of the readings, and what a relative effect of one would make of c (rms)
  double u_interpolation = 0;   ///< 1/sr, of a value that was interpolated
  std::vector<double> pattern;  ///< of the directed tests: what c would be (1/sr) for an amplitude of one
  std::size_t place = 0;        ///< contrasts of one place and channel are told together
};

struct Contrasts {
  std::vector<Reading> readings;
  std::vector<Contrast> contrasts;
  std::vector<std::string> pattern_names;
  /// Parts of the significance given to the directed tests; χ² has the rest. Their weighted Bonferroni combination is the p-value.
  std::vector<double> pattern_share;
  /// So many of the shared components, the last ones, are parameters to be estimated: their prior is wide and they use up freedom.
  std::size_t free_components = 0;
};

struct ContrastTest {
  std::size_t n = 0;             ///< contrasts with known uncertainty (all of them, if none has)
  bool has_uncertainty = false;  ///< if not, only n means anything
  double chi2 = 0, dof = 0;
  double effective_dof = 0;  ///< of χ² · effective_dof / dof: smaller than dof where contrasts share readings (Satterthwaite)
  double p_chi2 = 1, p_value = 1;
  double effect = 0, u_effect = 0, effect_upper = 0;  ///< relative, beyond the noise
  std::vector<DirectedTest> directed;                 ///< those that the data can see
  int strongest = -1;                                 ///< index into `directed`: the most significant one, -1 if none is
  std::vector<double> z;                              ///< per contrast, after the shared components; NaN where left out
  std::vector<double> amplitude, u_amplitude;         ///< of the shared components, in their standard deviations
};

/// χ² of all contrasts, and directed tests of one degree of freedom. Shared components have a unit-normal prior (generalised least
/// squares), so that a common scale or a tilt of known uncertainty is no violation. Contrasts that share readings are correlated; the
/// variances of the directed amplitudes and of χ² are formed from the readings, so that they stay right.
/// Effect: e of variance + e² scale² by moments (Mandel and Paule's equation with fixed weights), or the amplitude of the pattern where
/// a directed test saw what χ² did not. Contrasts with an unknown u are left out if any has all of them known.
ContrastTest test_contrasts(const Contrasts& set, double margin, double alpha);

/// What noise alone would explain: χ²/dof is large, but its size is even over the readings' relative uncertainties, the z are normal in
/// shape, and no directed test stands out once u is enlarged by √(χ²/dof) (Birge). Returns that factor if it is at most 3, else 1.
double understated_noise(const Contrasts& set, const ContrastTest& test, double alpha);

/// Fills the numbers and the verdict of a check from the test; the caller writes the sentence.
void judge_contrasts(Check& check, const ContrastTest& test, double margin, double alpha);

/// The p-value of every place (contrasts of one place and channel together), and what is told of it.
struct PlaceTests {
  std::vector<Place> places;
  std::vector<double> p;
};
PlaceTests place_tests(const Contrasts& set, const ContrastTest& test, const std::vector<std::string>& channels);

/// Fewer degrees of freedom than this cannot show equivalence: the moment estimate of the effect is not normal yet.
inline constexpr double enough_dof = 8;

}  // namespace gonio::fitting
