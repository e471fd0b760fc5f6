// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/incidence_folds.hpp"

#include <random>
#include <set>

#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

Folds folds_of(std::vector<GonioAngles> angles, std::size_t max_folds) {
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  data->f = {std::vector<double>(angles.size(), 0.1)};
  data->f[0].back() = std::nan("");
  data->angles = std::move(angles);
  return incidence_folds(*observe(data), max_folds);
}

}  // namespace

TEST_CASE("few incidences are left out one by one, even if their poses scatter") {
  auto angles = test::polar_grid({10, 30, 50}, 10, 30);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.1, 0.1);
  for (GonioAngles& a : angles) a.theta_i = degrees(a.theta_i.degrees() + jitter(random));
  const Folds folds = folds_of(angles, 10);
  CHECK(folds.over == Folds::Over::incidences);
  CHECK(folds.count == 3);
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) CHECK(folds.of_sample[k] == static_cast<int>((angles[k].theta_i.degrees() - 5) / 20));
  CHECK(folds.of_sample.back() == Folds::none);
  CHECK(description(folds) == "leave one incidence out (3 incidences)");
}

TEST_CASE("many incidences are dealt out to the folds so that each holds some from everywhere") {
  std::vector<double> incidences;
  for (int k = 0; k < 20; ++k) incidences.push_back(4.0 * k);
  const auto angles = test::polar_grid(incidences, 20, 60);
  const Folds folds = folds_of(angles, 5);
  CHECK(folds.over == Folds::Over::incidence_groups);
  CHECK(folds.count == 5);
  CHECK(folds.places == 20);
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) CHECK(folds.of_sample[k] == static_cast<int>(angles[k].theta_i.degrees() / 4) % 5);
}

TEST_CASE("scattered incidence is divided into bins of equally many samples") {
  std::vector<GonioAngles> angles;
  for (int k = 0; k <= 900; ++k) angles.push_back({degrees(k * 0.1), degrees(0), degrees(30), degrees(k)});
  const Folds folds = folds_of(angles, 9);
  CHECK(folds.over == Folds::Over::incidence_bins);
  CHECK(folds.count == 9);
  for (std::size_t k = 0; k + 1 < angles.size(); ++k) CHECK(folds.of_sample[k] == k / 100);
}

TEST_CASE("a single incidence leaves only outgoing angles to divide, and a handful of samples nothing") {
  const Folds one = folds_of(test::polar_grid({30}, 5, 10), 5);
  CHECK(one.over == Folds::Over::outgoing_bins);
  CHECK(one.count == 5);
  CHECK(std::set<int>(one.of_sample.begin(), one.of_sample.end() - 1).size() == 5);
  CHECK(description(one).find("one incidence only") != std::string::npos);
  const Folds few = folds_of(test::polar_grid({30}, 60, 180), 5);
  CHECK(few.over == Folds::Over::nothing);
  CHECK(few.count == 0);
}
