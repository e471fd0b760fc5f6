// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/lab_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "brdf/error.hpp"
#include "tabulated/formats/csv.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/stated_symmetry.hpp"
#include "tabulated/opened_samples.hpp"

namespace gonio::tabulated {
namespace {

/// True if the first line that is no comment has all of these fields.
bool has_header(std::string_view head, std::initializer_list<std::string_view> names) {
  CsvLines lines(head);
  auto line = lines.next();
  while (line && is_empty_line(*line)) line = lines.next();
  if (!line) return false;
  std::vector<std::string_view> fields;
  split(*line, separator_of(*line), fields);
  return std::all_of(names.begin(), names.end(),
                     [&](std::string_view name) { return std::find(fields.begin(), fields.end(), name) != fields.end(); });
}

/// The reading options that turn a known header into samples.
ReadOptions with_columns(const ReadOptions& options, std::vector<std::pair<std::string, std::string>> columns) {
  ReadOptions out = options;
  out.columns = std::move(columns);
  return out;
}

double radiance_factor_of_white(const std::filesystem::path& path, const ReadOptions& options) {
  const std::optional<std::string> answer = options.assumed("white");
  const Number white = answer ? parse_number(*answer) : Number{};
  if (answer && white.fault == nullptr && white.value > 0) return white.value;
  throw Error(
      ErrorKind::input,
      {path.string(), answer ? fmt::format("--assume white={}", *answer) : "readings relative to a white of unknown radiance factor",
       "--assume white=1 for a perfect diffuser, or its certified value at 8 deg : 0 deg"});
}

/// Takes out the samples at which the head of the detector is in the beam.
void mask_blocked(Dataset& samples) {
  constexpr double half_height_deg = 10, half_width_deg = 30, rounding = 1e-9;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const GonioAngles& pose = samples.angles[k];
    const bool beside_light = std::fabs(std::remainder(pose.phi_o.degrees() - pose.phi_i.degrees(), 360.0)) <= half_width_deg + rounding;
    if (pose.theta_o.degrees() > 0 && beside_light &&
        std::fabs(pose.theta_o.degrees() - pose.theta_i.degrees()) <= half_height_deg + rounding) {
      ++samples.masked.blocked;
      continue;
    }
    samples.angles[kept] = pose;
    for (auto& column : samples.f) column[kept] = column[k];
    for (auto& [name, column] : samples.extra) column[kept] = column[k];
    ++kept;
  }
  samples.angles.resize(kept);
  for (auto& column : samples.f) column.resize(kept);
  for (auto& [name, column] : samples.extra) column.resize(kept);
}

}  // namespace

bool recognises_rt300s(std::string_view head, std::uintmax_t) {
  return has_header(head, {"azimuth_deg", "incidence_deg", "receive_deg", "RT"});
}

Opened open_rt300s(const std::filesystem::path& path, const ReadOptions& options) {
  if (!options.columns.empty()) return open_csv(path, options);
  const double white = radiance_factor_of_white(path, options);
  const std::string blocked = options.assumed("blocked").value_or("mask");
  if (blocked != "mask" && blocked != "keep")
    throw Error(ErrorKind::input, {path.string(), fmt::format("--assume blocked={}", blocked), "mask or keep"});
  ReadOptions csv = with_columns(
      options, {{"phi_o_deg", "azimuth_deg"}, {"theta_i_deg", "incidence_deg"}, {"theta_o_deg", "receive_deg"}, {"value", "RT"}});
  csv.set["phi_i_deg"] = 90;
  csv.quantity = Quantity::signal_ratio;
  auto samples = std::make_shared<Dataset>(read_csv(path, csv));
  for (double& f : samples->f[0]) f *= white;
  if (blocked == "mask") mask_blocked(*samples);
  if (samples->size() == 0) throw Error(ErrorKind::input, {path.string(), "every sample is blocked", "--assume blocked=keep"});
  samples->symmetry = stated_symmetry(path, options);
  samples->provenance["instrument"] = "RT-300S";
  samples->provenance["white"] = fmt::format("radiance factor {}", white);
  Opened out = opened_samples("rt300s", samples);
  out.info.insert(out.info.begin(),
                  {{"holds", "signal relative to a white at 8 deg : 0 deg, made f = R RT / (pi cos receive)"},
                   {"unit", "1/sr"},
                   {"nodes", "at samples; light at azimuth 90 deg, azimuth -90 with receive > 0 is the specular side"},
                   {"blank", options.blank ? "subtracted" : "none subtracted: --blank FILE takes the readings with the source covered"}});
  return out;
}

bool recognises_nist(std::string_view head, std::uintmax_t) { return has_header(head, {"lambda", "thetai", "thetar", "phir", "f_r11"}); }

Opened open_nist(const std::filesystem::path& path, const ReadOptions& options) {
  if (!options.columns.empty()) return open_csv(path, options);
  auto samples = std::make_shared<Dataset>(read_csv(path, with_columns(options, {{"wavelength_um", "lambda"},
                                                                                 {"theta_i_deg", "thetai"},
                                                                                 {"phi_i_deg", "phi"},
                                                                                 {"theta_o_deg", "thetar"},
                                                                                 {"phi_o_deg", "phir"},
                                                                                 {"value", "f_r11"}})));
  samples->symmetry = stated_symmetry(path, options);
  Opened out = opened_samples("nist", samples);
  out.info.insert(out.info.begin(), {{"holds", "f for unpolarised light; the other elements of the Mueller matrix are dropped"},
                                     {"unit", "1/sr"},
                                     {"nodes", "at samples"}});
  return out;
}

}  // namespace gonio::tabulated
