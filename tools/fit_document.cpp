// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_document.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace gonio::tools {
namespace {

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

Json nuisance_document(const fitting::FitResult& result) {
  Json out = Json::array();
  for (const auto& p : result.nuisance) {
    Json interval;
    if (p.kind == fitting::IntervalKind::interval) {
      interval = Json::array();
      interval.push_back(or_null(p.low));
      interval.push_back(or_null(p.high));
    }
    out.push_back(Json::object({{"name", p.name},
                                {"unit", p.unit},
                                {"value", p.value},
                                {"sigma", or_null(p.sigma)},
                                {"interval", interval},
                                {"kind", name(p.kind)},
                                {"prior", or_null(p.prior)},
                                {"bound", p.bound}}));
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

/// Four digits: a residual says no more.
Json short_number(double value) { return std::stod(fmt::format("{:.4g}", value)); }

/// The cells that hold samples in any channel, column by column.
Json residual_map_document(const fitting::FitResult& result) {
  const fitting::ResidualMap& map = result.residuals;
  std::vector<std::size_t> filled;
  for (std::size_t k = 0; k < map.channel.front().size(); ++k)
    if (std::any_of(map.channel.begin(), map.channel.end(), [k](const auto& cells) { return cells[k].count > 0; })) filled.push_back(k);
  Json::Array theta_i, theta_o, channels;
  for (const std::size_t k : filled) {
    theta_i.push_back(fitting::ResidualMap::theta_i_deg(k));
    theta_o.push_back(fitting::ResidualMap::theta_o_deg(k));
  }
  for (std::size_t c = 0; c < map.channel.size(); ++c) {
    Json::Array count, mean, rms;
    for (const std::size_t k : filled) {
      const fitting::ResidualCell& cell = map.channel[c][k];
      count.push_back(static_cast<std::int64_t>(cell.count));
      mean.push_back(cell.count > 0 ? short_number(cell.mean) : Json());
      rms.push_back(cell.count > 0 ? short_number(cell.rms) : Json());
    }
    channels.push_back(Json::object({{"channel", result.channels[c].name}, {"count", count}, {"mean", mean}, {"rms", rms}}));
  }
  return Json::object({{"unit", map.sigma_known ? "sigma" : "rms"},
                       {"step_deg", fitting::ResidualMap::step_deg},
                       {"n_samples", static_cast<std::int64_t>(map.n_samples)},
                       {"theta_i_deg", theta_i},
                       {"theta_o_deg", theta_o},
                       {"channels", channels}});
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
  document.set("confidence", result.confidence);
  if (!options.is_null()) document.set("options", std::move(options));
  document.set("parameters", parameters_document(result));
  document.set("u_scale", or_null(result.u_scale));
  document.set("nuisance", nuisance_document(result));
  document.set("correlation", correlation_document(result.correlation));
  document.set("determined", determined_document(result));
  if (result.likelihood.n > 0) document.set("likelihood", likelihood_document(result.likelihood));
  document.set("errors", errors_document(result.errors));
  if (result.residuals.n_samples > 0) document.set("residual_map", residual_map_document(result));
  document.set("weighting", weighting_document(result));
  document.set("apertures", Json::object({{"on", result.aperture.on},
                                          {"reason", result.aperture.reason.empty() ? Json() : Json(result.aperture.reason)},
                                          {"bound", result.aperture.bound},
                                          {"n_samples", static_cast<std::int64_t>(result.aperture.n_samples)}}));
  document.set("rows", Json::object({{"of", name(result.rows.of)},
                                     {"count", static_cast<std::int64_t>(result.rows.count)},
                                     {"reason", result.rows.reason.empty() ? Json() : Json(result.rows.reason)}}));
  document.set("n_observations", static_cast<std::int64_t>(result.n_observations));
  document.set("n_masked", masked_document(masked, result.not_fitted));
  document.set("other_minima", minima_document(result));
  document.set("timings_s", Json::object({{"read", timings.read_s},
                                          {"fit", result.fit_s},
                                          {"total", timings.total_s},
                                          {"collapse", result.stages.collapse_s},
                                          {"weights", result.stages.weights_s},
                                          {"scan", result.stages.scan_s},
                                          {"intervals", result.stages.intervals_s},
                                          {"errors", result.stages.errors_s}}));
  document.set("checks", checks_array(result.checks));
  return document;
}

}  // namespace gonio::tools
