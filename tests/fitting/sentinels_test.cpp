// SPDX-License-Identifier: BSD-3-Clause
// Samples marked as missing by -1 are as if they were not there: in a table's rows and in a goniometer's file.
#include <random>

#include <fmt/format.h>

#include "fitting/fit.hpp"
#include "tabulated/formats/csv.hpp"
#include "tests/fitting/ngan_grid.hpp"
#include "tests/fitting/theta_h_table.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

constexpr unsigned seed = 20260701;
constexpr double share = .1;

FitResult fit_of(const Observations& observations) {
  FitOptions options;
  options.model = "blinn-phong-ngan";
  return fit(observations, options);
}

std::string row_text(const GonioAngles& angles, const std::vector<double>& f) {
  return fmt::format("{},{},{},{},{}\n", angles.theta_i.degrees(), angles.phi_i.degrees(), angles.theta_o.degrees(), angles.phi_o.degrees(),
                     fmt::join(f, ","));
}

}  // namespace

TEST_CASE("a table with 10 % of its cells at -1 gives the fit of the other cells") {
  for (const double s : {50.0, 2000.0, 20000.0}) {
    ThetaHTable marked = noisy_table(ngan_material(s), 200, seed), without = marked, untouched = marked;
    std::mt19937_64 random(seed);
    std::bernoulli_distribution missing(share);
    std::size_t count = 0;
    for (std::size_t row = 0; row < ThetaHTable::row_count; ++row)
      for (std::size_t k = marked.value[row][0].size(); k-- > 0;) {
        const bool below_horizon = marked.value[row][0][k] < 0;
        if (!below_horizon && !missing(random)) continue;
        count += !below_horizon;
        for (std::size_t c = 0; c < 3; ++c) {
          marked.value[row][c][k] = -1;
          without.value[row][c].erase(without.value[row][c].begin() + static_cast<std::ptrdiff_t>(k));
        }
      }
    const FitResult with_marks = fit_of(marked), clean = fit_of(without), all = fit_of(untouched);
    INFO("s " << s << ", seed " << seed << ": " << count << " cells marked");
    REQUIRE(clean.status == Status::converged);
    CHECK(with_marks.n_observations == all.n_observations - count);
    CHECK(with_marks.n_observations == clean.n_observations);
    REQUIRE(with_marks.parameters.size() == 7);
    for (std::size_t k = 0; k < 7; ++k) {
      CHECK(with_marks.parameters[k].value == Approx(clean.parameters[k].value).epsilon(1e-9));
      CHECK(*with_marks.parameters[k].low == Approx(*clean.parameters[k].low).epsilon(1e-9));
      CHECK(*with_marks.parameters[k].high == Approx(*clean.parameters[k].high).epsilon(1e-9));
    }
    // That is no matter of course: the other cells give another answer.
    CHECK(std::abs(all.parameters[6].value / clean.parameters[6].value - 1) > 1e-8);
  }
}

TEST_CASE("a file with 10 % of its rows at -1 gives the fit of the file without them, bit for bit") {
  const TemporaryFolder folder;
  const auto data = NoisyReadings(ngan_material(2000), gantry_grid()).draw(seed);
  std::mt19937_64 random(seed);
  std::bernoulli_distribution missing(share);
  std::string marked = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,r,g,b\n", without = marked;
  std::size_t count = 0;
  for (std::size_t k = 0; k < data->size(); ++k) {
    const bool is_missing = missing(random);
    const std::string own = row_text(data->angles[k], {data->f[0][k], data->f[1][k], data->f[2][k]});
    marked += is_missing ? row_text(data->angles[k], {-1, -1, -1}) : own;
    if (!is_missing) without += own;
    count += is_missing;
  }
  write_file(folder / "marked.csv", marked);
  write_file(folder / "without.csv", without);
  const auto read = [&](const char* name, const tabulated::ReadOptions& options = {}) {
    return std::make_shared<Dataset>(tabulated::read_csv(folder / name, options));
  };
  const auto samples = read("marked.csv");
  CHECK(samples->masked.missing == count);
  CHECK(samples->size() == data->size() - count);
  const FitResult with_marks = fit_of(*observe(samples)), clean = fit_of(*observe(read("without.csv")));
  REQUIRE(clean.status == Status::converged);
  CHECK(with_marks.values == clean.values);
  for (std::size_t k = 0; k < clean.parameters.size(); ++k) {
    CHECK(with_marks.parameters[k].low == clean.parameters[k].low);
    CHECK(with_marks.parameters[k].high == clean.parameters[k].high);
  }
  // Read as values they are no secret: a tenth of the readings is far below all others.
  tabulated::ReadOptions as_values;
  as_values.missing.reset();
  FitOptions least_squares;
  least_squares.model = "blinn-phong-ngan";
  least_squares.robust = Robust::none;
  CHECK(fit(*observe(read("marked.csv", as_values)), least_squares).values[0][0] < .5 * clean.values[0][0]);
}
