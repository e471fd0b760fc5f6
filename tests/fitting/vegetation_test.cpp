// SPDX-License-Identifier: BSD-3-Clause
// The published and independently refitted Phong parameters of the vegetation data.
#include <fstream>
#include <sstream>

#include "fitting/fit.hpp"
#include "tests/shared_data.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

/// Columns theta_i phi_i theta_o phi_o f, whatever the header says; empty if the data are not there.
std::shared_ptr<const Dataset> vegetation() {
  const auto path = test::measured_data("lumos/vegetation_brdf_cars.csv");
  if (!path) return nullptr;
  std::ifstream file(*path);
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("value");
  data->f.resize(1);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream text(line);
    double v[5];
    for (double& value : v) text >> value;
    data->angles.push_back({degrees(v[0]), degrees(v[1]), degrees(v[2]), degrees(v[3])});
    data->f[0].push_back(v[4]);
  }
  return data;
}

}  // namespace

TEST_CASE("the vegetation data give the independently refitted Phong parameters under every metric") {
  const auto data = vegetation();
  if (!data) return;
  struct Row {
    Metric metric;
    double rho_d, rho_s, s;
  };
  const auto observations = observe(data);
  for (const Row& row :
       {Row{Metric::log, .5340, .2840, 7.314}, Row{Metric::linear, .6249, .3513, 6.328}, Row{Metric::linear_cos, .6304, .2020, 8.225},
        Row{Metric::cbrt, .5630, .3032, 7.032}, Row{Metric::log1p, .6165, .2113, 8.191}}) {
    FitOptions options;
    options.model = "phong";
    options.metric = row.metric;
    const FitResult result = fit(*observations, options);
    INFO(name(row.metric) << ' ' << result.reason << ' ' << result.fit_s << " s");
    REQUIRE(result.status == Status::converged);
    CHECK(result.values[0][0] == Approx(row.rho_d).margin(1e-3));
    CHECK(result.values[0][1] == Approx(row.rho_s).margin(1e-3));
    CHECK(result.values[0][2] == Approx(row.s).margin(1e-3));
    CHECK(result.n_observations == 14500);
    CHECK(result.not_fitted.total() == 0);
  }
}
