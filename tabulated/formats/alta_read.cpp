// SPDX-License-Identifier: BSD-3-Clause
// Opening text files of the ALTA library.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/alta.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/quantity.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

using Coordinates = std::vector<double>;

/// theta_i, phi_i, theta_o, phi_o in radians.
using Pose = std::array<double, 4>;

Pose from_projected(const Coordinates& x) { return {x[0], 0, std::hypot(x[1], x[2]), x[1] == 0 && x[2] == 0 ? 0 : std::atan2(x[2], x[1])}; }
Pose from_difference(const Coordinates& x) { return {x[1], 0, x[0], x[2]}; }
Pose from_spherical(const Coordinates& x) { return {x[0], x[1], x[2], x[3]}; }

Pose from_half_difference(double theta_h, double phi_h, double theta_d, double phi_d) {
  const DirectionPair pair = directions({radians(theta_h), radians(phi_h), radians(theta_d), radians(phi_d)});
  const GonioAngles out = gonio_angles(pair.wi, pair.wo);
  return {out.theta_i.radians(), out.phi_i.radians(), out.theta_o.radians(), out.phi_o.radians()};
}
Pose from_isotropic_half(const Coordinates& x) { return from_half_difference(x[0], 0, x[1], x[2]); }
Pose from_half(const Coordinates& x) { return from_half_difference(x[0], x[1], x[2], x[3]); }
/// The cosine of theta_h; behind it theta_d and phi_d, which were answered.
Pose from_cosine(const Coordinates& x) {
  const double theta_h = std::atan2(std::sqrt(std::max(0.0, (1 - x[0]) * (1 + x[0]))), x[0]);
  return from_half_difference(theta_h, 0, x[1], x[2]);
}

struct Parameterisation {
  std::string_view name;
  std::size_t dimensions;
  bool isotropic;
  Pose (*pose)(const Coordinates&);
  /// Coordinates that stand in no row because the file is a slice at one value of each: keys of `--assume`.
  std::vector<const char*> slice = {};
};
const Parameterisation parameterisations[] = {{"ISOTROPIC_TL_TV_PROJ_DPHI", 3, true, from_projected},
                                              {"ISOTROPIC_TV_TL_DPHI", 3, true, from_difference},
                                              {"SPHERICAL_TL_PL_TV_PV", 4, false, from_spherical},
                                              {"RUSIN_TH_TD_PD", 3, true, from_isotropic_half},
                                              {"RUSIN_TH_PH_TD_PD", 4, false, from_half},
                                              {"RUSIN_TH_TD", 2, true, from_isotropic_half, {"phi_d_deg"}},
                                              {"COS_TH", 1, true, from_cosine, {"theta_d_deg", "phi_d_deg"}}};

std::string known_parameterisations() {
  std::string out;
  for (const Parameterisation& known : parameterisations) out += fmt::format("{}{}", out.empty() ? "" : ", ", known.name);
  return "one of " + out;
}

struct Header {
  const Parameterisation* parameterisation = nullptr;
  std::size_t values = 0;
  Quantity quantity = Quantity::f;
  std::map<std::string, std::string> texts;  ///< keys that only people read
};

/// `#KEY value` lines up to the first row.
std::map<std::string, std::string> header_lines(std::string_view text) {
  std::map<std::string, std::string> out;
  CsvLines lines(text);
  for (auto line = lines.next(); line && is_empty_line(*line); line = lines.next()) {
    const std::size_t hash = line->find('#');
    if (hash == std::string_view::npos || hash + 1 >= line->size() || (*line)[hash + 1] == ' ' || (*line)[hash + 1] == '\t') continue;
    const std::string_view entry = line->substr(hash + 1);
    const std::size_t end = std::min(entry.find_first_of(" \t"), entry.size());
    const std::size_t value = std::min(entry.find_first_not_of(" \t\"", end), entry.size());
    const std::size_t last = entry.find_last_not_of(" \t\"\r");
    out[std::string(entry.substr(0, end))] =
        std::string(value <= last && last != std::string_view::npos ? entry.substr(value, last + 1 - value) : "");
  }
  return out;
}

Header read_header(std::string_view text, FaultList& faults) {
  Header out;
  std::map<std::string, std::string> lines = header_lines(text);
  const auto taken = [&](const char* key) {
    const auto at = lines.find(key);
    const std::string value = at == lines.end() ? "" : at->second;
    if (at != lines.end()) lines.erase(at);
    return value;
  };
  const std::string in = taken("PARAM_IN"), quantity = taken("PARAM_OUT"), format = taken("FORMAT"), segments = taken("VS"),
                    dimensions = taken("DIM");
  const auto known =
      std::find_if(std::begin(parameterisations), std::end(parameterisations), [&](const Parameterisation& p) { return p.name == in; });
  if (known != std::end(parameterisations))
    out.parameterisation = known;
  else
    faults.add(faults.file(), fmt::format("PARAM_IN {}", excerpt(in)), known_parameterisations());
  if (quantity == "INV_STERADIAN_COSINE_FACTOR")
    out.quantity = Quantity::f_cos;
  else if (quantity != "INV_STERADIAN" && quantity != "RGB_COLOR")
    faults.add(faults.file(), fmt::format("PARAM_OUT {}", excerpt(quantity)), "INV_STERADIAN, INV_STERADIAN_COSINE_FACTOR or RGB_COLOR");
  if (!format.empty() && format != "text") faults.add(faults.file(), fmt::format("FORMAT {}", excerpt(format)), "text");
  if (segments.find_first_not_of("0 \t") != std::string::npos)
    faults.add(faults.file(), fmt::format("VS {}", excerpt(segments)), "0: values without segments");

  std::vector<std::string_view> fields;
  split(dimensions, blanks, fields);
  constexpr std::size_t most_values = 4096;
  const auto count = [](std::string_view field) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
    return error == std::errc() && end == field.data() + field.size() ? number : 0;
  };
  if (fields.size() == 2) out.values = count(fields[1]);
  if (fields.size() != 2 || out.values == 0 || out.values > most_values ||
      (out.parameterisation && count(fields[0]) != out.parameterisation->dimensions))
    faults.add(
        faults.file(), fmt::format("DIM {}", excerpt(dimensions)),
        fmt::format("the {} of the parameterisation and a number of values", out.parameterisation ? out.parameterisation->dimensions : 3));
  out.texts = std::move(lines);
  return out;
}

/// The coordinates of a slice that stand in no row, in radians.
Coordinates slice_of(const Parameterisation& parameterisation, const ReadOptions& options, FaultList& faults) {
  Coordinates out;
  for (const char* key : parameterisation.slice) {
    const auto answer = options.assumed(key);
    if (!answer) {
      faults.add(faults.file(), fmt::format("PARAM_IN {} alone: a slice at one {} that no row has", parameterisation.name, key),
                 fmt::format("--assume {}=DEGREES", key));
      continue;
    }
    const Number number = parse_number(*answer);
    if (number.fault != nullptr || !(std::fabs(number.value) <= 360))
      throw Error(ErrorKind::usage, {fmt::format("--assume {}", key), *answer, "an angle in degrees"});
    out.push_back(number.value * std::numbers::pi / 180);
  }
  return out;
}

/// Azimuth and zenith angle as ours: a negative zenith angle is half a turn of azimuth.
void place(double theta, double phi, Angle& theta_out, Angle& phi_out) {
  theta_out = radians(std::fabs(theta));
  phi_out = radians(theta < 0 ? phi + (phi > 0 ? -std::numbers::pi : std::numbers::pi) : phi);
}

/// Adds one row to the samples, or counts it as none.
void add_sample(const Coordinates& coordinates, const std::vector<double>& values, const Header& header, const ReadOptions& options,
                Dataset& out) {
  const auto all = [&](auto&& predicate) { return std::all_of(values.begin(), values.end(), predicate); };
  const auto is_nan = [](double value) { return std::isnan(value); };
  if (options.missing && all([&](double value) { return value == *options.missing; })) {
    ++out.masked.missing;
    return;
  }
  if (all(is_nan) || std::any_of(coordinates.begin(), coordinates.end(), is_nan)) {
    ++out.masked.nan;
    return;
  }
  const Pose pose = header.parameterisation->pose(coordinates);
  // A projected angle of 90° is the length of two rounded legs.
  constexpr double rounding = 1e-12;
  constexpr double horizon = std::numbers::pi / 2 + rounding;
  if (std::fabs(pose[0]) > horizon || std::fabs(pose[2]) > horizon) {
    ++out.masked.below_horizon;
    return;
  }
  GonioAngles angles;
  place(pose[0], pose[1], angles.theta_i, angles.phi_i);
  place(pose[2], pose[3], angles.theta_o, angles.phi_o);
  const double factor = factor_to_f(header.quantity, angles.theta_o);
  if (std::isnan(factor)) {
    ++out.masked.nan;
    return;
  }
  out.angles.push_back(angles);
  for (std::size_t c = 0; c < values.size(); ++c) out.f[c].push_back(values[c] * factor);
}

}  // namespace

Dataset read_alta(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string text = read_file(path);
  FaultList faults(path.string());
  const Header header = read_header(text, faults);
  faults.raise();
  const Coordinates slice = slice_of(*header.parameterisation, options, faults);
  faults.raise();

  Dataset out;
  out.symmetry.isotropic = header.parameterisation->isotropic;
  if (header.values == 3)
    out.channels = rgb_channels();
  else if (header.values == 1)
    out.channels = single_channel("value");
  else
    for (std::size_t c = 0; c < header.values; ++c) out.channels.push_back(single_channel(fmt::format("value{}", c + 1)).front());
  out.f.resize(header.values);

  const std::size_t dimensions = header.parameterisation->dimensions;
  Coordinates coordinates(dimensions + slice.size());
  std::vector<double> values(header.values);
  std::vector<std::string_view> fields;
  CsvLines lines(text);
  for (auto line = lines.next(); line; line = lines.next()) {
    if (is_empty_line(*line)) continue;
    split(*line, blanks, fields);
    if (fields.size() != dimensions + header.values) {
      faults.add_at(lines.number(), fmt::format("{} numbers", fields.size()), fmt::format("{}, as DIM says", dimensions + header.values));
      continue;
    }
    bool sound = true;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const Number number = parse_number(fields[k]);
      if (number.fault != nullptr) {
        faults.add_at(lines.number(), fmt::format("{} {} in column {}", number.fault, excerpt(fields[k]), k + 1),
                      "a finite number, or nan");
        sound = false;
      }
      (k < dimensions ? coordinates[k] : values[k - dimensions]) = number.value;
    }
    if (!sound) continue;
    std::copy(slice.begin(), slice.end(), coordinates.begin() + static_cast<std::ptrdiff_t>(dimensions));
    add_sample(coordinates, values, header, options, out);
  }
  faults.raise();
  if (out.size() == 0)
    throw Error(ErrorKind::input,
                {path.string(), fmt::format("no sample, {} rows that are none", out.masked.total()), "at least one value"});
  out.provenance = {{"source", path.filename().string()}, {"source_quantity", name(header.quantity)}};
  for (const auto& [key, value] : header.texts) {
    std::string lower = key;
    for (char& c : lower)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (!value.empty()) out.provenance[lower] = value;
  }
  return out;
}

bool recognises_alta(std::string_view head, std::uintmax_t) {
  const auto starts_a_line = [&](std::string_view key) {
    for (std::size_t at = head.find(key); at != std::string_view::npos; at = head.find(key, at + 1))
      if (at == 0 || head[at - 1] == '\n') return true;
    return false;
  };
  return starts_a_line("#DIM ") && starts_a_line("#PARAM_IN");
}

Opened open_alta(const std::filesystem::path& path, const ReadOptions& options) {
  Opened out = opened_grid("alta", std::make_shared<const Dataset>(read_alta(path, options)));
  const std::string quantity = out.dataset->provenance.at("source_quantity");
  out.info.insert(
      out.info.begin(),
      {{"holds", quantity == "f_cos" ? "f cos theta_o" : "f, cosine not included"}, {"unit", "1/sr"}, {"nodes", "at the samples"}});
  return out;
}

}  // namespace gonio::tabulated
