// SPDX-License-Identifier: BSD-3-Clause
#include "tools/output.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tools/renderer_targets.hpp"

namespace gonio::tools {
namespace {

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

/// A line broken at blanks where it is longer than a wide terminal, what follows behind `indent` blanks.
std::vector<std::string> wrapped(const std::string& line, std::size_t indent) {
  constexpr std::size_t width = 120;
  std::vector<std::string> out;
  std::string rest = line;
  while (rest.size() > width) {
    const std::size_t at = rest.rfind(' ', width);
    if (at == rest.npos || at <= indent) break;
    out.push_back(rest.substr(0, at));
    rest = std::string(indent, ' ') + rest.substr(at + 1);
  }
  out.push_back(rest);
  return out;
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

std::string place_text(const fitting::Place& place) {
  const GonioAngles& a = place.angles;
  std::string text = fmt::format("({:.6g}°, {:.6g}°) -> ({:.6g}°, {:.6g}°), channel {}", a.theta_i.degrees(), a.phi_i.degrees(),
                                 a.theta_o.degrees(), a.phi_o.degrees(), place.channel);
  if (place.ratio) text += fmt::format(", ratio {:.4g}", *place.ratio);
  if (place.z) text += fmt::format(", z {:.1f}", *place.z);
  if (place.p_holm && place.p_bh) text += fmt::format(", p {:.2g} (Holm), {:.2g} (BH)", *place.p_holm, *place.p_bh);
  return text;
}

}  // namespace

std::string writable_formats() {
  std::string out;
  for (const auto* list : {&tabulated::formats(), &renderer_formats()})
    for (const auto& format : *list)
      if (format.write) out += (out.empty() ? "" : ", ") + std::string(format.name);
  return out;
}

const tabulated::Format& writable_format(const std::string& name) {
  for (const auto* list : {&tabulated::formats(), &renderer_formats()})
    for (const auto& format : *list)
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

Json masked_document(const MaskedCounts& masked, const fitting::NotFitted& not_fitted) {
  Json reasons = Json::object();
  for (const fitting::Omission omission : fitting::every_omission)
    reasons.set(name(omission), static_cast<std::int64_t>(not_fitted[omission]));
  Json out = masked_document(masked);
  out.set("not_fitted", static_cast<std::int64_t>(not_fitted.total()));
  out.set("not_fitted_by_reason", reasons);
  return out;
}

std::string masked_text(const MaskedCounts& masked, const fitting::NotFitted& not_fitted) {
  using fitting::Omission;
  std::string text;
  for (const auto& [count, what] : {std::pair{masked.nan + not_fitted[Omission::no_value], "NaN"},
                                    {std::max(masked.missing, not_fitted[Omission::marked]), "marked as missing"},
                                    {masked.below_horizon + not_fitted[Omission::below_horizon], "below the horizon"},
                                    {masked.blocked, "blocked"},
                                    {not_fitted[Omission::no_uncertainty], "without an uncertainty"},
                                    {not_fitted[Omission::outside_metric], "outside the domain of the metric"}})
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "masked: " : ", ", count, what);
  return text;
}

Json checks_array(const std::vector<fitting::Check>& checks) {
  Json out = Json::array();
  for (const fitting::Check& check : checks) out.push_back(check_document(check));
  return out;
}

Json checks_document(const std::vector<fitting::Check>& checks, Json context) {
  return Json::object({{"context", std::move(context)}, {"checks", checks_array(checks)}});
}

std::vector<std::string> check_lines(const std::vector<fitting::Check>& checks) {
  constexpr std::size_t indent = 28;
  constexpr double least_p = 1e-15;  // below it the digits are those of the distribution's far tail
  std::vector<std::string> lines;
  for (const auto& check : checks) {
    std::string p;
    if (check.p_value) p = *check.p_value < least_p ? fmt::format(" (p < {:g})", least_p) : fmt::format(" (p = {:.2g})", *check.p_value);
    for (std::string& line : wrapped(fmt::format("  {:<16} {:<8} {}{}", check.id, name(check.verdict), check.detail, p), indent))
      lines.push_back(std::move(line));
    if (check.verdict == fitting::Verdict::vacuous) continue;  // its places tell as little as it does
    for (const auto& place : check.where) lines.push_back("    at " + place_text(place));
  }
  return lines;
}

}  // namespace gonio::tools
