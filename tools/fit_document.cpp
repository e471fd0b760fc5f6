// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_document.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::tools {
namespace {

std::string channel_name(const fitting::FitResult& result, const fitting::FittedParameter& parameter) {
  return parameter.channel ? result.channels[*parameter.channel].name : std::string();
}

/// Decimals that show two significant digits of a width.
int decimals_for(double width) { return width > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 15) : 15; }

std::string with_uncertainty(double value, double u) {
  const int digits = decimals_for(u);
  return fmt::format("{:.{}f} ± {:.{}f}", value, digits, u, digits);
}

std::string interval_text(const fitting::FittedParameter& p) {
  using fitting::IntervalKind;
  switch (p.kind) {
    case IntervalKind::interval: {
      const double low = p.low.value_or(NAN), high = p.high.value_or(NAN);
      const int digits = decimals_for(high - low);
      return fmt::format("95 % interval [{:.{}f}, {:.{}f}]", low, digits, high, digits);
    }
    case IntervalKind::lower_bound: return fmt::format("at least {:.6g} (95 %)", p.low.value_or(NAN));
    case IntervalKind::upper_bound: return fmt::format("at most {:.6g} (95 %)", p.high.value_or(NAN));
    case IntervalKind::unidentified: return "the data do not determine it";
    case IntervalKind::fixed: return "held fixed";
  }
  return {};
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json correlation_document(const std::vector<std::vector<double>>& correlation) {
  Json rows = Json::array();
  for (const auto& row : correlation) {
    Json values = Json::array();
    for (const double value : row) values.push_back(finite_or_null(value));
    rows.push_back(values);
  }
  return rows;
}

Json determined_document(const fitting::FitResult& result) {
  Json out = Json::array();
  for (const auto& found : result.determined) {
    Json interval = Json::array();
    interval.push_back(found.low);
    interval.push_back(found.high);
    out.push_back(Json::object({{"expression", found.expression},
                                {"unit", found.unit},
                                {"channel", result.channels[found.channel].name},
                                {"value", found.value},
                                {"sigma", or_null(found.sigma)},
                                {"interval", interval}}));
  }
  return out;
}

Json likelihood_document(const fitting::FitLikelihood& likelihood) {
  return Json::object({{"log_likelihood", finite_or_null(likelihood.log_likelihood)},
                       {"free_parameters", static_cast<std::int64_t>(likelihood.free_parameters)},
                       {"n", static_cast<std::int64_t>(likelihood.n)},
                       {"aicc", finite_or_null(likelihood.aicc())},
                       {"bic", finite_or_null(likelihood.bic())}});
}

Json minima_document(const fitting::FitResult& result) {
  Json minima = Json::array();
  for (const auto& minimum : result.other_minima) {
    Json nonlinear = Json::array(), linear = Json::array();
    for (const double value : minimum.nonlinear) nonlinear.push_back(value);
    for (const auto& set : minimum.linear) {
      Json values = Json::array();
      for (const double value : set) values.push_back(value);
      linear.push_back(values);
    }
    minima.push_back(Json::object({{"channel", minimum.channel ? Json(result.channels[*minimum.channel].name) : Json()},
                                   {"nonlinear", nonlinear},
                                   {"linear", linear},
                                   {"cost", minimum.cost},
                                   {"cost_ratio", minimum.cost_ratio}}));
  }
  return minima;
}

/// Where the weights came from, and the readings found to be wrong.
Json weighting_document(const fitting::FitResult& result) {
  const fitting::Weighting& weighting = result.weighting;
  Json outliers = Json::array(), variance = Json::array();
  for (const fitting::Outlier& outlier : weighting.outliers)
    outliers.push_back(Json::object({{"sample", static_cast<std::int64_t>(outlier.sample)},
                                     {"channel", result.channels[outlier.channel].name},
                                     {"theta_i_deg", outlier.angles.theta_i.degrees()},
                                     {"phi_i_deg", outlier.angles.phi_i.degrees()},
                                     {"theta_o_deg", outlier.angles.theta_o.degrees()},
                                     {"phi_o_deg", outlier.angles.phi_o.degrees()},
                                     {"value", outlier.value},
                                     {"fitted", outlier.fitted},
                                     {"z", outlier.z}}));
  for (std::size_t c = 0; c < weighting.variance.size(); ++c) {
    const fitting::VarianceModel& model = weighting.variance[c];
    variance.push_back(Json::object(
        {{"channel", result.channels[c].name}, {"read", model.read}, {"shot", model.shot}, {"gain", model.gain}, {"tilt", model.tilt}}));
  }
  return Json::object({{"source", name(weighting.source)},
                       {"variance", variance},
                       {"robust", name(weighting.robust)},
                       {"reason", weighting.reason.empty() ? Json() : Json(weighting.reason)},
                       {"n_outliers", static_cast<std::int64_t>(weighting.n_outliers)},
                       {"outliers", outliers}});
}

/// The same in one line; empty where every sample counted alike.
std::string weighting_line(const fitting::FitResult& result) {
  const fitting::Weighting& weighting = result.weighting;
  std::string text;
  if (weighting.source != fitting::WeightSource::none) text = fmt::format("  weights from: {}", name(weighting.source));
  if (weighting.n_outliers > 0)
    text += fmt::format("{}{} outliers ({}{}{})", text.empty() ? "  " : "; ", weighting.n_outliers, name(weighting.robust),
                        weighting.reason.empty() ? "" : ": ", weighting.reason);
  return text;
}

}  // namespace

Json parameters_document(const fitting::FitResult& result) {
  using fitting::IntervalKind;
  Json parameters = Json::array();
  for (const auto& p : result.parameters) {
    Json interval;
    if (p.kind == IntervalKind::interval || p.kind == IntervalKind::lower_bound || p.kind == IntervalKind::upper_bound) {
      interval = Json::array();
      interval.push_back(or_null(p.low));
      interval.push_back(or_null(p.high));
    }
    parameters.push_back(Json::object({{"name", p.name},
                                       {"channel", p.channel ? Json(result.channels[*p.channel].name) : Json()},
                                       {"value", p.value},
                                       {"sigma", or_null(p.sigma)},
                                       {"interval", interval},
                                       {"kind", name(p.kind)},
                                       {"lower", p.lower},
                                       {"upper", p.upper}}));
  }
  return parameters;
}

Json errors_document(const fitting::FitErrors& e) {
  return Json::object({{"linear", e.linear},
                       {"linear_cos", e.linear_cos},
                       {"log", e.log},
                       {"log1p", e.log1p},
                       {"cbrt", e.cbrt},
                       {"chi2_per_dof", or_null(e.chi2_per_dof)}});
}

Json fit_document(const fitting::FitResult& result, const MaskedCounts& masked, const FitTimings& timings, Json context, Json options) {
  Json document = Json::object({{"context", std::move(context)}, {"status", name(result.status)}});
  if (!result.reason.empty()) document.set("reason", result.reason);
  document.set("model", result.model);
  document.set("metric", name(result.metric));
  if (!options.is_null()) document.set("options", std::move(options));
  document.set("parameters", parameters_document(result));
  document.set("correlation", correlation_document(result.correlation));
  document.set("determined", determined_document(result));
  if (result.likelihood.n > 0) document.set("likelihood", likelihood_document(result.likelihood));
  document.set("errors", errors_document(result.errors));
  document.set("weighting", weighting_document(result));
  document.set("apertures", Json::object({{"on", result.aperture.on},
                                          {"reason", result.aperture.reason.empty() ? Json() : Json(result.aperture.reason)},
                                          {"bound", result.aperture.bound},
                                          {"n_samples", static_cast<std::int64_t>(result.aperture.n_samples)}}));
  document.set("n_observations", static_cast<std::int64_t>(result.n_observations));
  Json counts = masked_document(masked);
  const std::size_t in_fit = result.n_masked;
  counts.set("not_fitted", static_cast<std::int64_t>(in_fit));
  document.set("n_masked", counts);
  document.set("other_minima", minima_document(result));
  document.set("timings_s", Json::object({{"read", timings.read_s}, {"fit", timings.fit_s}, {"total", timings.total_s}}));
  document.set("checks", checks_array(result.checks));
  return document;
}

std::vector<std::string> fit_lines(const fitting::FitResult& result) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} by {}: {}{}, {} samples", result.model, name(result.metric), name(result.status),
                              result.reason.empty() ? "" : " (" + result.reason + ")", result.n_observations));
  for (const auto& p : result.parameters) {
    const std::string channel = channel_name(result, p);
    const std::string value = p.sigma && *p.sigma > 0 ? with_uncertainty(p.value, *p.sigma) : fmt::format("{:.6g}", p.value);
    lines.push_back(fmt::format("  {:<8} {:<8} {:<26} {}", p.name, channel, value, interval_text(p)));
  }
  std::string errors;
  for (const auto& [metric, error] : {std::pair{"linear", result.errors.linear},
                                      {"linear-cos", result.errors.linear_cos},
                                      {"log", result.errors.log},
                                      {"log1p", result.errors.log1p},
                                      {"cbrt", result.errors.cbrt}})
    if (!std::isnan(error)) errors += fmt::format("{}{} {:.4g}", errors.empty() ? "  rms error: " : ", ", metric, error);
  if (result.errors.chi2_per_dof)
    errors += fmt::format("{}chi2 per degree of freedom {:.3f}", errors.empty() ? "  " : "; ", *result.errors.chi2_per_dof);
  if (!errors.empty()) lines.push_back(errors);
  if (const std::string line = weighting_line(result); !line.empty()) lines.push_back(line);
  if (result.aperture.on) lines.push_back("  " + result.aperture.reason);
  for (const auto& minimum : result.other_minima)
    lines.push_back(
        fmt::format("  another minimum at {:.6g} with {:.4g} times the cost", fmt::join(minimum.nonlinear, ", "), minimum.cost_ratio));
  for (const auto& line : check_lines(result.checks)) lines.push_back(line);
  return lines;
}

}  // namespace gonio::tools
