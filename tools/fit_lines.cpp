// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_lines.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "brdf/model_info.hpp"
#include "tools/output.hpp"

namespace gonio::tools {
namespace {

/// Decimals that show two significant digits of a width.
int decimals_for(double width) { return width > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 15) : 15; }

std::string with_uncertainty(double value, double u) {
  const int digits = decimals_for(u);
  return fmt::format("{:.{}f} ± {:.{}f}", value, digits, u, digits);
}

std::string interval_text(const fitting::FittedParameter& p, double confidence) {
  using fitting::IntervalKind;
  const std::string percent = fmt::format("{:g} %", 100 * confidence);
  switch (p.kind) {
    case IntervalKind::interval: {
      const double low = p.low.value_or(NAN), high = p.high.value_or(NAN);
      const int digits = decimals_for(high - low);
      return fmt::format("{} interval [{:.{}f}, {:.{}f}]", percent, low, digits, high, digits);
    }
    case IntervalKind::lower_bound: return fmt::format("at least {:.6g} ({})", p.low.value_or(NAN), percent);
    case IntervalKind::upper_bound: return fmt::format("at most {:.6g} ({})", p.high.value_or(NAN), percent);
    case IntervalKind::unidentified: return "the data do not determine it";
    case IntervalKind::fixed: return "held fixed";
  }
  return {};
}

using Row = std::vector<std::string>;

/// Characters, of which UTF-8 takes several bytes for some.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Columns as wide as their widest cell, indented by two.
std::vector<std::string> aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> width;
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k == width.size()) width.push_back(0);
      width[k] = std::max(width[k], width_of(row[k]));
    }
  std::vector<std::string> out;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      line += "  " + row[k];
      if (k + 1 < row.size()) line += std::string(width[k] - width_of(row[k]), ' ');
    }
    out.push_back(line);
  }
  return out;
}

std::string value_text(const fitting::FittedParameter& p, const ModelInfo& model) {
  const std::string number = p.sigma && *p.sigma > 0 ? with_uncertainty(p.value, *p.sigma) : fmt::format("{:.6g}", p.value);
  const auto known = std::find_if(model.parameters.begin(), model.parameters.end(), [&](const Parameter& q) { return q.name == p.name; });
  return known == model.parameters.end() || known->unit == "1" ? number : fmt::format("{} {}", number, known->unit);
}

/// The same where there is no room for an interval beside it.
std::string short_text(const fitting::FittedParameter& p, const ModelInfo& model) {
  using fitting::IntervalKind;
  switch (p.kind) {
    case IntervalKind::interval: return value_text(p, model);
    case IntervalKind::lower_bound: return fmt::format("> {:.4g}", p.low.value_or(NAN));
    case IntervalKind::upper_bound: return fmt::format("< {:.4g}", p.high.value_or(NAN));
    case IntervalKind::unidentified: return "undetermined";
    case IntervalKind::fixed: return fmt::format("{:.6g} fixed", p.value);
  }
  return {};
}

/// Value and interval of a nuisance parameter, and what was known of it before.
Row nuisance_cells(const fitting::NuisanceParameter& p, double confidence) {
  const std::string unit = p.unit == "deg" ? "°" : "", before = p.prior ? fmt::format("; stated ± {:.3g}", *p.prior) : "";
  if (!p.sigma && p.value == 0) return {"held at 0", "the data do not determine it"};
  if (!p.sigma) return {fmt::format("{:.4g}{}", p.value, unit), "the end of its range: not plausible, look for another cause"};
  const int digits = decimals_for(2 * *p.sigma);
  return {with_uncertainty(p.value, *p.sigma) + unit, fmt::format("{:g} % interval [{:.{}f}, {:.{}f}]{}", 100 * confidence,
                                                                  p.low.value_or(NAN), digits, p.high.value_or(NAN), digits, before)};
}

/// A line for every parameter, those of the model first; of many channels a line for every channel, with what belongs to it, and then the
/// shared ones.
std::vector<std::string> parameter_lines(const fitting::FitResult& result) {
  constexpr std::size_t few_channels = 4;
  const ModelInfo& model = model_info(result.model);
  const std::size_t channels = result.channels.size();
  std::vector<Row> table(1, Row{"channel"}), rows;
  for (const fitting::FittedParameter& p : result.parameters) {
    if (p.channel && channels > few_channels) {
      if (std::find(table[0].begin(), table[0].end(), p.name) == table[0].end()) table[0].push_back(p.name);
      table.resize(std::max(table.size(), *p.channel + 2));
      Row& row = table[*p.channel + 1];
      if (row.empty()) row.push_back(result.channels[*p.channel].name);
      row.push_back(short_text(p, model));
      continue;
    }
    Row row{p.name};
    if (channels > 1 && channels <= few_channels) row.push_back(p.channel ? result.channels[*p.channel].name : "");
    row.push_back(value_text(p, model));
    row.push_back(interval_text(p, result.confidence));
    rows.push_back(std::move(row));
  }
  for (const fitting::NuisanceParameter& p : result.nuisance) {
    Row row{p.name};
    if (channels > 1 && channels <= few_channels) row.emplace_back();
    for (std::string& cell : nuisance_cells(p, result.confidence)) row.push_back(std::move(cell));
    rows.push_back(std::move(row));
  }
  std::vector<std::string> lines;
  if (table.size() > 1) {
    lines = aligned(table);
    lines.push_back(
        fmt::format("  (± one standard uncertainty; --json has the {:g} % intervals of all channels)", 100 * result.confidence));
  }
  for (std::string& line : aligned(rows)) lines.push_back(std::move(line));
  return lines;
}

/// The cell whose mean residual is farthest from chance; empty if none is.
std::string residual_line(const fitting::FitResult& result) {
  const fitting::ResidualMap& map = result.residuals;
  constexpr double beyond_chance = 5;  // standard deviations of a mean: none of a few hundred cells by chance
  double farthest = beyond_chance;
  std::string text;
  for (std::size_t c = 0; c < map.channel.size(); ++c)
    for (std::size_t k = 0; k < map.channel[c].size(); ++k) {
      const fitting::ResidualCell& cell = map.channel[c][k];
      const double significance = std::abs(cell.mean) * std::sqrt(static_cast<double>(cell.count));
      if (significance <= farthest) continue;
      farthest = significance;
      const double theta_i = fitting::ResidualMap::theta_i_deg(k), theta_o = fitting::ResidualMap::theta_o_deg(k);
      const double half = fitting::ResidualMap::step_deg / 2;
      text =
          fmt::format("  misses most at theta_i {:g} to {:g}°, theta_o {:g} to {:g}°: data - fit = {:+.2g} {} in the mean of {} readings{}",
                      theta_i - half, theta_i + half, theta_o - half, theta_o + half, cell.mean, map.sigma_known ? "σ" : "rms", cell.count,
                      map.channel.size() > 1 ? ", channel " + result.channels[c].name : "");
    }
  return text;
}

/// Where the weights came from, in one line; empty where every sample counted alike.
std::string weighting_line(const fitting::FitResult& result) {
  const fitting::Weighting& weighting = result.weighting;
  std::string text;
  if (weighting.source != fitting::WeightSource::none) text = fmt::format("  weights from: {}", name(weighting.source));
  if (weighting.source == fitting::WeightSource::solid_angle) text += ", which is not noise: do not take the intervals for uncertainties";
  if (weighting.n_outliers > 0)
    text += fmt::format("{}{} outliers ({}{}{})", text.empty() ? "  " : "; ", weighting.n_outliers, name(weighting.robust),
                        weighting.reason.empty() ? "" : ": ", weighting.reason);
  return text;
}

}  // namespace

std::vector<std::string> fit_lines(const fitting::FitResult& result, const MaskedCounts& masked) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} by {}: {}{}, {} samples{}", result.model, name(result.metric), name(result.status),
                              result.reason.empty() ? "" : " (" + result.reason + ")", result.n_observations,
                              result.channels.size() > 1 ? fmt::format(", {} channels", result.channels.size()) : ""));
  for (std::string& line : parameter_lines(result)) lines.push_back(std::move(line));
  if (result.u_scale)
    lines.push_back(fmt::format("  common scale of all samples ± {:.3g} % (k = 1): not in the intervals of the linear parameters",
                                100 * *result.u_scale));
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
  if (const std::string line = residual_line(result); !line.empty()) lines.push_back(line);
  if (const std::string line = weighting_line(result); !line.empty()) lines.push_back(line);
  if (const std::string text = masked_text(masked, result.not_fitted); !text.empty()) lines.push_back("  " + text);
  if (!result.rows.reason.empty()) lines.push_back("  " + result.rows.reason);
  if (result.aperture.on) lines.push_back("  " + result.aperture.reason);
  for (const auto& minimum : result.other_minima)
    lines.push_back(
        fmt::format("  another minimum at {:.6g} with {:.4g} times the cost", fmt::join(minimum.nonlinear, ", "), minimum.cost_ratio));
  for (const auto& line : check_lines(result.checks)) lines.push_back(line);
  return lines;
}

}  // namespace gonio::tools
