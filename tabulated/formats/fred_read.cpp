// SPDX-License-Identifier: BSD-3-Clause
// Reading tabulated scatter of FRED.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/fred.hpp"
#include "tabulated/formats/keyword_text.hpp"
#include "tabulated/opened_samples.hpp"

namespace gonio::tabulated {
namespace {

struct FormatLine {
  bool direction_cosines = false, logarithm = false;
  double scale = 1;
};

FormatLine read_format(std::string_view line, std::size_t number, FaultList& faults) {
  FormatLine out;
  bool angles = false, bsdf = false;
  std::vector<std::string_view> words;
  split(line, blanks, words);
  if (words.empty() || !same_word(words.front(), "format")) {
    faults.add_at(number, excerpt(line), "format angles=deg bsdf=value scale=1");
    return out;
  }
  for (std::size_t k = 1; k < words.size(); ++k) {
    const std::size_t equals = std::min(words[k].find('='), words[k].size());
    const std::string_view key = words[k].substr(0, equals), value = words[k].substr(std::min(equals + 1, words[k].size()));
    if (same_word(key, "angles") && (same_word(value, "deg") || same_word(value, "sin"))) {
      out.direction_cosines = same_word(value, "sin");
      angles = true;
    } else if (same_word(key, "bsdf") && (same_word(value, "value") || same_word(value, "log"))) {
      out.logarithm = same_word(value, "log");
      bsdf = true;
    } else if (same_word(key, "scale")) {
      const Number scale = parse_number(value);
      out.scale = scale.value;
      if (scale.fault != nullptr || !(scale.value > 0)) faults.add_at(number, excerpt(words[k]), "scale= and a positive number");
    } else if (!same_word(key, "exclude") && !same_word(key, "num")) {  // they steer FRED's own interpolation
      faults.add_at(number, excerpt(words[k]), "angles=deg|sin, bsdf=value|log, scale=, exclude= or num=");
    }
  }
  if (!angles) faults.add_at(number, "no angles=", "angles=deg or angles=sin");
  if (!bsdf) faults.add_at(number, "no bsdf=", "bsdf=value or bsdf=log");
  return out;
}

struct Polar {
  Angle theta, phi;
};

std::optional<Polar> direction(double first, double second, const FormatLine& format) {
  if (!format.direction_cosines) {
    if (!(std::fabs(first) <= 90)) return std::nullopt;
    return Polar{degrees(std::fabs(first)), degrees(first < 0 ? second + (second < 180 ? 180 : -180) : second)};
  }
  const double sine = std::hypot(first, second);
  if (!(sine <= 1)) return std::nullopt;
  return Polar{angle_of(sine, std::sqrt(1 - sine * sine)), angle_of(first, second)};
}

/// All samples lie on one side of the plane of incidence: FRED takes them for both.
bool on_one_side(const std::vector<GonioAngles>& angles) {
  bool left = false, right = false;
  for (const GonioAngles& pose : angles) {
    const double across = pose.theta_o.sin() * (pose.phi_o - pose.phi_i).sin();
    constexpr double rounding = 1e-9;
    left = left || across > rounding, right = right || across < -rounding;
  }
  return left != right;
}

}  // namespace

Dataset read_fred(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const std::string bytes = read_file(path);
  CsvLines lines(bytes);
  std::vector<std::string_view> fields;
  const auto next_line = [&] {
    auto line = lines.next();
    while (line && is_empty_line(*line)) line = lines.next();
    return line;
  };
  const auto type = next_line();
  if (type) split(*type, blanks, fields);
  if (!type || fields.size() != 2 || !same_word(fields[0], "type") || !same_word(fields[1], "bsdf_data"))
    faults.add_at(lines.number(), type ? excerpt(*type) : "an empty file", "type bsdf_data");
  const auto format_line = next_line();
  if (!format_line) faults.add_at(lines.number(), "the end of the file", "format angles=deg bsdf=value scale=1");
  faults.raise();
  const FormatLine format = read_format(*format_line, lines.number(), faults);
  faults.raise();

  Dataset out;
  out.channels = single_channel("value");
  out.f.resize(1);
  const std::string side = options.assumed("side").value_or("reflection");
  if (side != "reflection" && side != "transmission")
    faults.add(faults.file(), fmt::format("--assume side={}", side), "reflection or transmission");
  out.side = side == "transmission" ? Side::transmission : Side::reflection;
  std::optional<Polar> specular;
  double first_azimuth = 0;
  bool several_azimuths = false, sampled = false;
  for (auto line = next_line(); line; line = next_line()) {
    split(*line, separator_of(*line), fields);
    double numbers[3] = {0, 0, 0};
    bool sound = fields.size() == 2 || fields.size() == 3;
    if (!sound) faults.add_at(lines.number(), fmt::format("{} numbers", fields.size()), "a specular direction of two or a sample of three");
    for (std::size_t k = 0; sound && k < fields.size(); ++k) {
      const Number number = parse_number(fields[k]);
      numbers[k] = number.value;
      if (number.fault == nullptr && !std::isnan(number.value)) continue;
      faults.add_at(lines.number(), excerpt(fields[k]), "a finite number");
      sound = false;
    }
    if (!sound) continue;
    const std::optional<Polar> polar = direction(numbers[0], numbers[1], format);
    if (!polar) {
      faults.add_at(lines.number(), fmt::format("the direction {} {}", numbers[0], numbers[1]), "one above the surface");
      continue;
    }
    if (fields.size() == 2) {
      sampled = false;
      if (!specular) first_azimuth = polar->phi.degrees();
      // At the normal the azimuth says nothing.
      several_azimuths = several_azimuths || (polar->theta.degrees() > 0 && polar->phi.degrees() != first_azimuth);
      specular = polar;
      continue;
    }
    if (!specular) {
      faults.add_at(lines.number(), "a sample before any specular direction", "a line of two numbers first");
      continue;
    }
    const double value = format.scale * (format.logarithm ? std::exp(std::numbers::ln10 * numbers[2]) : numbers[2]);
    if (!std::isfinite(value)) {
      faults.add_at(lines.number(), fmt::format("log10 f = {}", numbers[2]), "a value within the range of double precision");
      continue;
    }
    const Angle theta_o = out.side == Side::transmission ? degrees(180) - polar->theta : polar->theta;
    out.angles.push_back({specular->theta, specular->phi + degrees(180), theta_o, polar->phi});
    out.f[0].push_back(value);
    sampled = true;
  }
  if (faults.empty() && out.size() == 0) faults.add(faults.file(), "no sample", "at least one");
  if (faults.empty() && specular && !sampled)
    faults.add_at(lines.number(), "the end of the file after a specular direction without samples", "samples of each");
  faults.raise();
  out.symmetry = {.isotropic = !several_azimuths, .bilateral = !several_azimuths && on_one_side(out.angles)};
  out.provenance = {{"source", path.filename().string()}};
  return out;
}

bool recognises_fred(std::string_view head, std::uintmax_t) {
  CsvLines lines(head);
  auto line = lines.next();
  while (line && is_empty_line(*line)) line = lines.next();
  std::vector<std::string_view> words;
  if (line) split(*line, blanks, words);
  return words.size() == 2 && same_word(words[0], "type") && same_word(words[1], "bsdf_data");
}

Opened open_fred(const std::filesystem::path& path, const ReadOptions& options) {
  Opened out = opened_samples("fred", std::make_shared<const Dataset>(read_fred(path, options)));
  out.info.insert(
      out.info.begin(),
      {{"holds", "f, cosine not included"}, {"unit", "1/sr"}, {"nodes", "at samples; FRED names the specular direction instead of wi"}});
  return out;
}

}  // namespace gonio::tabulated
