// SPDX-License-Identifier: BSD-3-Clause
// The words of the command line and of documents for what a fit is asked and what it finds.
#include <algorithm>
#include <array>
#include <utility>

#include "fitting/fit.hpp"

namespace gonio::fitting {
namespace {

constexpr std::array<std::pair<Metric, const char*>, 5> metric_names{{{Metric::linear, "linear"},
                                                                      {Metric::linear_cos, "linear-cos"},
                                                                      {Metric::log, "log"},
                                                                      {Metric::log1p, "log1p"},
                                                                      {Metric::cbrt, "cbrt"}}};

}  // namespace

const char* name(Metric metric) noexcept {
  for (const auto& [value, text] : metric_names)
    if (value == metric) return text;
  return "linear";
}

std::optional<Metric> metric_named(std::string_view text) {
  for (const auto& [value, known] : metric_names)
    if (text == known) return value;
  return std::nullopt;
}

std::optional<NuisanceOptions> nuisance_named(std::string_view list) {
  NuisanceOptions out;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string_view word = list.substr(begin, end - begin);
    if (word == "tilt")
      out.tilt = true;
    else if (word == "azimuth")
      out.azimuth = true;
    else if (word == "components")
      out.components = true;
    else
      return std::nullopt;
    begin = end + 1;
  }
  return out;
}

std::string name(const NuisanceOptions& nuisance) {
  std::string out;
  for (const auto& [asked, word] : {std::pair{nuisance.tilt, "tilt"}, {nuisance.azimuth, "azimuth"}, {nuisance.components, "components"}})
    if (asked) out += (out.empty() ? "" : ",") + std::string(word);
  return out;
}

const char* name(Status status) noexcept {
  switch (status) {
    case Status::converged: return "converged";
    case Status::not_converged: return "not_converged";
    case Status::no_usable_data: return "no_usable_data";
    case Status::failed: return "failed";
  }
  return "failed";
}

const char* name(RowsOf rows) noexcept {
  switch (rows) {
    case RowsOf::samples: return "samples";
    case RowsOf::table_rows: return "table_rows";
    case RowsOf::directions: return "directions";
    case RowsOf::psi_bins: return "psi_bins";
    case RowsOf::theta_h_bins: return "theta_h_bins";
  }
  return "samples";
}

const char* name(IntervalKind kind) noexcept {
  switch (kind) {
    case IntervalKind::interval: return "interval";
    case IntervalKind::lower_bound: return "lower_bound";
    case IntervalKind::upper_bound: return "upper_bound";
    case IntervalKind::unidentified: return "unidentified";
    case IntervalKind::fixed: return "fixed";
  }
  return "unidentified";
}

}  // namespace gonio::fitting
