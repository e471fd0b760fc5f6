// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/rgb_to_spectrum.hpp"

#include <cmath>
#include <vector>

#include "tabulated/colour_matching.hpp"

#include "tests/check.hpp"

using namespace gonio::tabulated;

TEST_CASE("The spectra of the primaries lie in [0, 1], sum to 1 and give back their primary under D65") {
  const auto& primaries = PrimarySpectra::values();
  std::vector<double> wavelengths;
  for (std::size_t k = 0; k < PrimarySpectra::count; ++k) {
    wavelengths.push_back(PrimarySpectra::first_nm + PrimarySpectra::step_nm * double(k));
    double sum = 0;
    for (const auto& spectrum : primaries) {
      CHECK(spectrum[k] >= 0);
      CHECK(spectrum[k] <= 1);
      sum += spectrum[k];
    }
    CHECK(std::fabs(sum - 1) < 1e-12);
  }
  CHECK(wavelengths.back() == 830);
  const auto weights = rgb_weights(wavelengths);
  constexpr double digits_of_the_table = 1e-6;
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t c = 0; c < 3; ++c) {
      double seen = 0;
      for (std::size_t k = 0; k < wavelengths.size(); ++k) seen += weights[c][k] * primaries[p][k];
      CHECK(std::fabs(seen - (p == c ? 1 : 0)) < digits_of_the_table);
    }
}

TEST_CASE("The spectra of the primaries are smooth: no step of 10 nm is larger than 0.3") {
  for (const auto& spectrum : PrimarySpectra::values())
    for (std::size_t k = 1; k < spectrum.size(); ++k) CHECK(std::fabs(spectrum[k] - spectrum[k - 1]) < 0.3);
}
