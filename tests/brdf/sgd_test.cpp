// SPDX-License-Identifier: BSD-3-Clause
// The shifted gamma distribution evaluates its published tables.
#include "brdf/models/sgd.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "tests/random_directions.hpp"
#include "tests/shared_data.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr double pi = std::numbers::pi;

/// The model as published, colour by colour, written down plainly.
double published(std::map<std::string, double> p, const Direction& wi, const Direction& wo) {
  const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z(), length = std::sqrt(hx * hx + hy * hy + hz * hz);
  const double ch = hz / length, cd = length / 2, x = p["alpha"] + (1 / (ch * ch) - 1) / p["alpha"];
  const double distribution = p["K"] * std::exp(-x) / std::pow(x, p["p"]) / (pi * std::pow(ch, 4));
  const double fresnel = p["F0"] - p["F1"] * cd + (1 - p["F0"]) * std::pow(1 - cd, 5);
  const auto shadow = [&](double c) {
    const double theta = std::acos(c);
    const double g = theta > p["theta0"] ? 1 + p["lambda"] * (1 - std::exp(p["c"] * std::pow(theta - p["theta0"], p["k"]))) : 1;
    return std::isnan(g) ? 0 : std::min(1.0, std::max(0.0, g));
  };
  return p["rho_d"] / pi + p["rho_s"] * distribution * std::max(0.0, fresnel) * shadow(wi.z()) * shadow(wo.z()) / (pi * wi.z() * wo.z());
}

std::vector<double> ours(std::map<std::string, double> p) {
  return {p["rho_d"], p["rho_s"] * p["K"], p["alpha"], p["p"], p["F0"], p["F1"], p["lambda"], p["c"], p["k"], p["theta0"]};
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) out.push_back(cell);
  return out;
}

}  // namespace

TEST_CASE("SGD is the published formula") {
  // white-marble, red (Bagher et al. 2012, supplemental material).
  const std::map<std::string, double> marble{{"rho_d", 0.236183}, {"rho_s", 0.24075}, {"alpha", 0.00430204}, {"p", 0.681306},
                                             {"F0", 0.118569},    {"F1", 0.0620704},  {"K", 103.053},        {"lambda", 1.0396},
                                             {"c", 1.08288e-07},  {"k", 88.7766},     {"theta0", 0.378101}};
  const AnalyticBrdf model("sgd", single_channel("r"), {ours(marble)});
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  for (int k = 0; k < 500; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    CHECK(model.eval(wi, wo)[0] == Approx(published(marble, wi, wo)).epsilon(1e-9));
  }
}

TEST_CASE("every published SGD material is evaluated as published", "[data]") {
  const auto path = test::measured_data("fits/sgd_bagher2012.csv");
  if (!path) return;
  std::ifstream file(*path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = split(line);
  test::Random random(test::seed);
  INFO("seed " << test::seed);
  int materials = 0, different = 0;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line);
    ++materials;
    for (const char colour : {'r', 'g', 'b'}) {
      std::map<std::string, double> p;
      for (std::size_t k = 2; k < header.size(); ++k)
        if (header[k].size() > 2 && header[k].back() == colour) p[header[k].substr(0, header[k].size() - 2)] = std::stod(cells[k]);
      const AnalyticBrdf model("sgd", single_channel("Y"), {ours(p)});
      for (int k = 0; k < 50; ++k) {
        const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
        const double expected = published(p, wi, wo);
        different += model.eval(wi, wo)[0] != Approx(expected).epsilon(1e-8).margin(1e-12);
      }
    }
  }
  CHECK(materials == 100);
  CHECK(different == 0);
}
