// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gonio::tools {
namespace {

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json place_document(const fitting::Place& place) {
  return Json::object({{"theta_i_deg", place.angles.theta_i.degrees()},
                       {"phi_i_deg", place.angles.phi_i.degrees()},
                       {"theta_o_deg", place.angles.theta_o.degrees()},
                       {"phi_o_deg", place.angles.phi_o.degrees()},
                       {"channel", place.channel},
                       {"ratio", or_null(place.ratio)},
                       {"z", or_null(place.z)},
                       {"p_holm", or_null(place.p_holm)},
                       {"p_bh", or_null(place.p_bh)}});
}

Json directed_document(const fitting::DirectedTest& test) {
  return Json::object({{"pattern", test.pattern}, {"amplitude", test.amplitude}, {"u", test.u}, {"z", test.z}, {"p_value", test.p_value}});
}

Json incidence_document(const fitting::IncidenceAlbedo& incidence) {
  return Json::object({{"theta_i_deg", incidence.theta_i_deg},
                       {"phi_i_deg", incidence.phi_i_deg},
                       {"channel", incidence.channel},
                       {"albedo", incidence.albedo},
                       {"u_noise", incidence.u_noise},
                       {"u_quadrature", incidence.u_quadrature},
                       {"u_scale", incidence.u_scale},
                       {"covered", incidence.covered},
                       {"missing_bound", incidence.missing_bound}});
}

/// Sets `name` to the list of documents if there are any.
template <class T>
void set_list(Json& document, const char* name, const std::vector<T>& items, Json (*item_document)(const T&)) {
  if (items.empty()) return;
  Json list = Json::array();
  for (const T& item : items) list.push_back(item_document(item));
  document.set(name, list);
}

Json check_document(const fitting::Check& check) {
  Json document = Json::object({{"id", check.id},
                                {"verdict", name(check.verdict)},
                                {"statistic", or_null(check.statistic)},
                                {"p_value", or_null(check.p_value)},
                                {"effect", or_null(check.effect)},
                                {"u_effect", or_null(check.u_effect)},
                                {"unit", check.unit},
                                {"threshold", or_null(check.threshold)},
                                {"n", static_cast<std::int64_t>(check.n)},
                                {"detail", check.detail}});
  set_list(document, "directed", check.directed, &directed_document);
  set_list(document, "where", check.where, &place_document);
  set_list(document, "incidences", check.incidences, &incidence_document);
  return document;
}

Json check_array(const std::vector<fitting::Check>& checks) {
  Json out = Json::array();
  for (const fitting::Check& check : checks) out.push_back(check_document(check));
  return out;
}

std::string place_text(const fitting::Place& place) {
  const GonioAngles& a = place.angles;
  std::string text = fmt::format("({:.6g}°, {:.6g}°) -> ({:.6g}°, {:.6g}°), channel {}", a.theta_i.degrees(), a.phi_i.degrees(),
                                 a.theta_o.degrees(), a.phi_o.degrees(), place.channel);
  if (place.ratio) text += fmt::format(", ratio {:.4g}", *place.ratio);
  if (place.z) text += fmt::format(", z {:.1f}", *place.z);
  if (place.p_holm && place.p_bh) text += fmt::format(", p {:.2g} (Holm), {:.2g} (BH)", *place.p_holm, *place.p_bh);
  return text;
}

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

}  // namespace

std::string writable_formats() {
  std::string out;
  for (const auto& format : tabulated::formats())
    if (format.write) out += (out.empty() ? "" : ", ") + std::string(format.name);
  return out;
}

const tabulated::Format& writable_format(const std::string& name) {
  for (const auto& format : tabulated::formats())
    if (format.write && name == format.name) return format;
  throw Error(ErrorKind::usage, {"--to", "'" + name + "'", "one of " + writable_formats()});
}

const tabulated::Format& format_of_name(const std::string& out) {
  if (out.ends_with(".csv")) return writable_format("csv");
  if (out.ends_with(".exr")) return writable_format("brdf-exr");
  if (out.ends_with(".binary")) return writable_format("merl");
  throw Error(ErrorKind::usage, {"--out", "'" + out + "'", "a name that ends in .csv, .brdf.exr or .binary"});
}

Json masked_document(const MaskedCounts& masked) {
  const auto count = [](std::size_t n) { return Json(static_cast<std::int64_t>(n)); };
  return Json::object({{"nan", count(masked.nan)},
                       {"missing", count(masked.missing)},
                       {"below_horizon", count(masked.below_horizon)},
                       {"blocked", count(masked.blocked)}});
}

Json fit_document(const fitting::FitResult& result, const MaskedCounts& masked, const FitTimings& timings, Json context, Json options) {
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
  Json minima = Json::array();
  for (const auto& minimum : result.other_minima) {
    Json nonlinear = Json::array(), linear = Json::array();
    for (const double value : minimum.nonlinear) nonlinear.push_back(value);
    for (const auto& set : minimum.linear) {
      Json values = Json::array();
      for (const double value : set) values.push_back(value);
      linear.push_back(values);
    }
    minima.push_back(
        Json::object({{"nonlinear", nonlinear}, {"linear", linear}, {"cost", minimum.cost}, {"cost_ratio", minimum.cost_ratio}}));
  }
  const auto& e = result.errors;
  Json document = Json::object({{"context", std::move(context)}, {"status", name(result.status)}});
  if (!result.reason.empty()) document.set("reason", result.reason);
  document.set("model", result.model);
  document.set("metric", name(result.metric));
  if (!options.is_null()) document.set("options", std::move(options));
  document.set("parameters", parameters);
  document.set("errors", Json::object({{"linear", e.linear},
                                       {"linear_cos", e.linear_cos},
                                       {"log", e.log},
                                       {"log1p", e.log1p},
                                       {"cbrt", e.cbrt},
                                       {"chi2_per_dof", or_null(e.chi2_per_dof)}}));
  document.set("n_observations", static_cast<std::int64_t>(result.n_observations));
  Json counts = masked_document(masked);
  const std::size_t in_fit = result.n_masked;
  counts.set("not_fitted", static_cast<std::int64_t>(in_fit));
  document.set("n_masked", counts);
  document.set("other_minima", minima);
  document.set("timings_s", Json::object({{"read", timings.read_s}, {"fit", timings.fit_s}, {"total", timings.total_s}}));
  document.set("checks", check_array(result.checks));
  return document;
}

Json checks_document(const std::vector<fitting::Check>& checks, Json context) {
  return Json::object({{"context", std::move(context)}, {"checks", check_array(checks)}});
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
  const auto& e = result.errors;
  lines.push_back(fmt::format("  rms error: linear {:.4g}, linear-cos {:.4g}, log {:.4g}, log1p {:.4g}, cbrt {:.4g}{}", e.linear,
                              e.linear_cos, e.log, e.log1p, e.cbrt,
                              e.chi2_per_dof ? fmt::format("; chi2 per degree of freedom {:.3f}", *e.chi2_per_dof) : ""));
  for (const auto& minimum : result.other_minima)
    lines.push_back(fmt::format("  another minimum at {} with {:.4g} times the cost",
                                minimum.nonlinear.empty() ? 0.0 : minimum.nonlinear.front(), minimum.cost_ratio));
  for (const auto& line : check_lines(result.checks)) lines.push_back(line);
  return lines;
}

std::vector<std::string> check_lines(const std::vector<fitting::Check>& checks) {
  std::vector<std::string> lines;
  for (const auto& check : checks) {
    std::string p;
    if (check.p_value) p = fmt::format(" (p = {:.2g})", *check.p_value);
    lines.push_back(fmt::format("  {:<16} {:<8} {}{}", check.id, name(check.verdict), check.detail, p));
    for (const auto& place : check.where) lines.push_back("    at " + place_text(place));
  }
  return lines;
}

}  // namespace gonio::tools
