// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare_document.hpp"

#include <fmt/format.h>

namespace gonio::tools {
namespace {

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json source_document(const ComparedSource& source) { return Json::object({{"source", source.source}, {"format", source.format}}); }

Json largest_document(const std::optional<fitting::LargestDifference>& largest, const fitting::ComparedValues& values) {
  if (!largest) return {};
  return Json::object({{"theta_i_deg", largest->angles.theta_i.degrees()},
                       {"phi_i_deg", largest->angles.phi_i.degrees()},
                       {"theta_o_deg", largest->angles.theta_o.degrees()},
                       {"phi_o_deg", largest->angles.phi_o.degrees()},
                       {"channel", values.channels[largest->channel].name},
                       {"a", largest->a},
                       {"b", largest->b},
                       {"difference", largest->difference}});
}

/// What the comparison was made at.
std::string detail(const fitting::ComparedValues& values, Angle theta_max) {
  switch (values.at) {
    case fitting::ComparedAt::common_directions:
      return fmt::format("{} directions that both sets of samples have; {} of A have no partner in B", values.angles.size(),
                         values.without_partner);
    case fitting::ComparedAt::samples_of_a:
      return fmt::format("{} samples of A against B {}", values.angles.size(),
                         values.other_is_samples ? "interpolated there" : "evaluated there");
    case fitting::ComparedAt::samples_of_b: return fmt::format("{} samples of B against A evaluated there", values.angles.size());
    case fitting::ComparedAt::quadrature: break;
  }
  return fmt::format("{} pairs of directions up to {:g}° by their solid angle, {}", values.angles.size(), theta_max.degrees(),
                     values.isotropic ? "both isotropic" : "azimuths of the sample included");
}

std::string place(const fitting::LargestDifference& largest, const fitting::ComparedValues& values) {
  return fmt::format("A {:.5g}, B {:.5g} 1/sr at theta_i {:.4g}°, phi_i {:.4g}°, theta_o {:.4g}°, phi_o {:.4g}°{}", largest.a, largest.b,
                     largest.angles.theta_i.degrees(), largest.angles.phi_i.degrees(), largest.angles.theta_o.degrees(),
                     largest.angles.phi_o.degrees(),
                     values.channels.size() > 1 ? fmt::format(", channel {}", values.channels[largest.channel].name) : "");
}

std::string number(const std::optional<double>& value, double factor, const char* unit) {
  return value ? fmt::format("{:.4g}{}", factor * *value, unit) : std::string("-");
}

}  // namespace

Json compare_document(const ComparedSource& a, const ComparedSource& b, const fitting::ComparedValues& values,
                      const fitting::Comparison& comparison, Angle theta_max, const std::vector<std::string>& images, Json context) {
  Json channels = Json::array(), metrics = Json::array(), incidences = Json::array(), pictures = Json::array();
  for (const fitting::ComparedChannel& channel : values.channels) channels.push_back(channel.name);
  for (const fitting::MetricError& error : comparison.metrics)
    metrics.push_back(Json::object({{"metric", error.metric},
                                    {"channel", error.channel ? Json(values.channels[*error.channel].name) : Json()},
                                    {"absolute", or_null(error.absolute)},
                                    {"relative", or_null(error.relative)},
                                    {"n", static_cast<std::int64_t>(error.n)}}));
  for (const fitting::IncidenceDifference& incidence : comparison.incidences)
    incidences.push_back(Json::object({{"theta_i_deg", incidence.theta_i_deg},
                                       {"n", static_cast<std::int64_t>(incidence.n)},
                                       {"absolute", incidence.absolute},
                                       {"relative", or_null(incidence.relative)},
                                       {"bias", or_null(incidence.bias)},
                                       {"largest_relative", incidence.largest_relative}}));
  for (const std::string& image : images) pictures.push_back(image);
  Json chi_square;
  if (const auto& chi = comparison.chi_square)
    chi_square = Json::object({{"n", static_cast<std::int64_t>(chi->n)},
                               {"independent_per_n", chi->independent_per_n},
                               {"correlated_per_n", chi->correlated_per_n},
                               {"p_value", chi->p_value},
                               {"uncertainty_of", chi->uncertainty_of}});
  const bool quadrature = values.at == fitting::ComparedAt::quadrature;
  return Json::object({{"context", std::move(context)},
                       {"a", source_document(a)},
                       {"b", source_document(b)},
                       {"compared_at", name(values.at)},
                       {"detail", detail(values, theta_max)},
                       {"theta_max_deg", quadrature ? Json(theta_max.degrees()) : Json()},
                       {"channels", channels},
                       {"n", static_cast<std::int64_t>(comparison.n)},
                       {"n_unknown", static_cast<std::int64_t>(comparison.n_unknown)},
                       {"n_not_positive", static_cast<std::int64_t>(comparison.n_not_positive)},
                       {"metrics", metrics},
                       {"largest", Json::object({{"absolute", largest_document(comparison.largest_absolute, values)},
                                                 {"relative", largest_document(comparison.largest_relative, values)}})},
                       {"incidences", incidences},
                       {"chi_square", chi_square},
                       {"images", pictures}});
}

std::vector<std::string> compare_lines(const fitting::ComparedValues& values, const fitting::Comparison& comparison, Angle theta_max) {
  std::vector<std::string> out{detail(values, theta_max),
                               fmt::format("{} values, {} known on one side at most", comparison.n, comparison.n_unknown),
                               fmt::format("  {:<12} {:<10} {:>12} {:>12}", "rms of B - A", "channel", "absolute", "relative")};
  for (const fitting::MetricError& error : comparison.metrics)
    out.push_back(fmt::format("  {:<12} {:<10} {:>12} {:>12}", error.metric, error.channel ? values.channels[*error.channel].name : "all",
                              number(error.absolute, 1, ""), number(error.relative, 100, " %")));
  out.push_back(
      fmt::format("  {:<12} {:>10} {:>12} {:>12} {:>12} {:>12}", "incidence", "values", "absolute", "relative", "bias", "largest"));
  for (const fitting::IncidenceDifference& incidence : comparison.incidences)
    out.push_back(fmt::format("  {:<11.4g}° {:>10} {:>12.4g} {:>12} {:>12} {:>10.4g} %", incidence.theta_i_deg, incidence.n,
                              incidence.absolute, number(incidence.relative, 100, " %"), number(incidence.bias, 100, " %"),
                              100 * incidence.largest_relative));
  if (comparison.largest_absolute)
    out.push_back(fmt::format("  largest difference {:.4g} 1/sr: {}", comparison.largest_absolute->difference,
                              place(*comparison.largest_absolute, values)));
  if (comparison.largest_relative)
    out.push_back(fmt::format("  largest relative difference {:.4g} %: {}", 100 * comparison.largest_relative->difference,
                              place(*comparison.largest_relative, values)));
  if (const auto& chi = comparison.chi_square)
    out.push_back(fmt::format("  chi2/n {:.3f} with independent uncertainties, {:.3f} with correlated components (n {}, p {:.3g}; of {})",
                              chi->independent_per_n, chi->correlated_per_n, chi->n, chi->p_value,
                              chi->uncertainty_of == "both" ? "both sides" : "side " + chi->uncertainty_of + ", the other taken as exact"));
  return out;
}

}  // namespace gonio::tools
