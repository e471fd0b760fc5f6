// SPDX-License-Identifier: BSD-3-Clause
// gonio eval: values of a model or a BRDF file at directions from standard input.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tools/brdf_source.hpp"
#include "tools/measured_table.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

constexpr int threads = 2;  // for the table of samples

std::string printed(double value) { return std::isnan(value) ? "nan" : fmt::format("{:.17g}", value); }

std::vector<double> numbers_of(const std::string& line, std::size_t wanted, int line_number) {
  std::istringstream stream(line);
  std::vector<double> numbers;
  std::string text;
  while (stream >> text) numbers.push_back(number_from(text, fmt::format("standard input, line {}", line_number)));
  if (numbers.size() != wanted)
    throw Error(ErrorKind::input, {fmt::format("standard input, line {}", line_number), fmt::format("{} numbers", numbers.size()),
                                   wanted == 4 ? "theta_i phi_i theta_o phi_o in degrees" : "theta_i phi_i in degrees"});
  for (const double number : numbers)
    if (!std::isfinite(number))
      throw Error(ErrorKind::input, {fmt::format("standard input, line {}", line_number), "a number that is not finite", "finite angles"});
  return numbers;
}

/// Directional albedo of any BRDF by the midpoint rule in projected solid angle (512 x 512); NaN where a value is unknown.
std::vector<double> albedo_by_quadrature(const Brdf& brdf, const Direction& wi) {
  constexpr int n = 512;
  const std::size_t channels = brdf.channels().size();
  std::vector<double> sum(channels, 0.0), f(channels * n);
  std::vector<Direction> in(n, wi), out(n);
  for (int a = 0; a < n; ++a) {
    const double sin2 = (a + 0.5) / n, r = std::sqrt(sin2), z = std::sqrt(1 - sin2);
    for (int b = 0; b < n; ++b) {
      const double phi = 2 * std::numbers::pi * (b + 0.5) / n;
      out[static_cast<std::size_t>(b)] = Direction::trusted(r * std::cos(phi), r * std::sin(phi), z);
    }
    brdf.eval(in, out, f);
    for (std::size_t k = 0; k < f.size(); ++k) sum[k % channels] += f[k];
  }
  for (double& value : sum) value *= std::numbers::pi / (double{n} * n);
  return sum;
}

}  // namespace

int eval_verb(const Arguments& arguments, Console& console) {
  CLI::App app(
      "Reads lines `theta_i phi_i theta_o phi_o` (degrees) from standard input and prints f per channel [1/sr, cosine not included],\n"
      "17 digits, `nan` where nothing is known. Samples are interpolated as their ratio to a guide, as `gonio export` does.",
      "eval");
  std::string source;
  std::vector<std::string> parameters;
  bool albedo = false, nearest = false;
  ReadFlags flags;
  TableFlags table_flags;
  app.add_option("SOURCE", source, "A model's name or any BRDF file")->required();
  app.add_option("--param", parameters, "NAME=VALUE of the model")->take_all();
  app.add_flag("--albedo", albedo, "Reads `theta_i phi_i` and prints the directional albedo");
  app.add_flag("--nearest", nearest, "Between samples the mean of the nearest ones by distance: faster, and worse at peaks");
  flags.add_to(app);
  table_flags.add_interpolation_to(app);
  add_common(app, console);
  if (!parse(app, arguments)) return 0;
  table_flags.imposed();

  tabulated::Opened opened = open_source(source, parameters, flags);
  TableReport table;
  if (!nearest) opened = measured_table(opened, table_flags, threads, table);
  if (const std::string line = interpolation_line(table); !line.empty()) console.note(fmt::format("{}: {}", source, line));
  if (const std::string warning = coverage_warning(table); !warning.empty()) console.note(fmt::format("{}: {}", source, warning));
  if (!opened.brdf) throw Error(ErrorKind::input, {source, opened.format + " that cannot be evaluated", "a model or a table"});
  const auto* model = dynamic_cast<const AnalyticBrdf*>(opened.brdf.get());

  Json rows = Json::array(), uncertainties = Json::array(), coverages = Json::array();
  std::string line;
  std::size_t n_values = 0, n_extrapolated = 0;
  for (int number = 1; std::getline(std::cin, line); ++number) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const auto n = numbers_of(line, albedo ? 2 : 4, number);
    std::vector<double> values;
    if (albedo) {
      const bool below = degrees(n[0]).cos() < 0;
      if (below)
        values.assign(opened.brdf->channels().size(), 0.0);
      else
        values = model ? model->directional_albedo(degrees(n[0]))
                       : albedo_by_quadrature(*opened.brdf, Direction::spherical(degrees(n[0]), degrees(n[1])));
    } else {
      const GonioAngles angles{degrees(n[0]), degrees(n[1]), degrees(n[2]), degrees(n[3])};
      if (opened.uncertain) {
        const Direction wi = angles.wi(), wo = angles.wo();
        values.resize(opened.brdf->channels().size());
        std::vector<double> u(values.size());
        Coverage coverage{};
        opened.uncertain->eval_with_uncertainty({&wi, 1}, {&wo, 1}, values, u, {&coverage, 1});
        ++n_values, n_extrapolated += coverage == Coverage::extrapolated ? 1 : 0;
        Json row = Json::array();
        for (const double one : u) row.push_back(std::isnan(one) ? Json() : Json(one));
        uncertainties.push_back(std::move(row)), coverages.push_back(name(coverage));
      } else {
        values = model ? model->eval(angles) : opened.brdf->eval(angles.wi(), angles.wo());
      }
    }
    if (console.json) {
      Json row = Json::array();
      for (const double value : values) row.push_back(value);
      rows.push_back(row);
      continue;
    }
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : " ") + printed(value);
    console.print(text);
  }
  if (n_extrapolated > 0)
    console.note(fmt::format("{}: {} of {} values lie beyond the samples: guesses, bounded by energy", source, n_extrapolated, n_values));
  if (console.json) {
    Json channels = Json::array();
    for (const Channel& channel : opened.brdf->channels()) channels.push_back(channel.name);
    std::vector<HashedInput> inputs;
    if (opened.format != "model") inputs.push_back(hash_in_background(source));
    Json document = Json::object({{"context", context(inputs, std::nullopt, opened.simulated)},
                                  {"source", source},
                                  {"quantity", albedo ? "directional_albedo" : "f"},
                                  {"channels", channels},
                                  {"values", rows}});
    if (n_values > 0) document.set("u", std::move(uncertainties)), document.set("coverage", std::move(coverages));
    console.print_json(document);
  }
  return 0;
}

}  // namespace gonio::tools
