// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/astm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/keyword_text.hpp"
#include "tabulated/formats/stated_symmetry.hpp"
#include "tabulated/samples_to_write.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

/// Header line of our own files.
constexpr std::string_view convention_line = "CONVENTION specular at phi_s - phi_i = pi";
constexpr std::string_view isotropic_line = "CONVENTION isotropic", bilateral_line = "CONVENTION isotropic and bilateral";
constexpr std::string_view transmission_line = "CONVENTION transmission, theta_s from the normal of the other side";

struct Header {
  std::size_t points = 0;
  bool has_points = false, ours = false, transmission = false, isotropic = false, bilateral = false;
  std::vector<std::string> variables;
  std::string text;  ///< free lines
};

Header read_header(CsvLines& lines, FaultList& faults) {
  Header out;
  std::vector<std::string_view> fields;
  for (auto line = lines.next(); line; line = lines.next()) {
    if (*line == convention_line) out.ours = true;
    if (*line == transmission_line) out.transmission = true;
    if (*line == isotropic_line || *line == bilateral_line) out.isotropic = true;
    if (*line == bilateral_line) out.bilateral = true;
    if (line->starts_with("NUM_POINTS")) {
      const std::string_view rest = line->substr(std::string_view("NUM_POINTS").size());
      split(rest, blanks, fields);
      const Number number = fields.size() == 1 ? parse_number(fields[0]) : Number{0, "no number"};
      constexpr double most = 1e12;
      if (number.fault != nullptr || !(number.value >= 0 && number.value < most && number.value == std::floor(number.value)))
        faults.add_at(lines.number(), excerpt(*line), "NUM_POINTS and a number");
      else
        out.points = static_cast<std::size_t>(number.value), out.has_points = true;
      continue;
    }
    if (line->starts_with("VARS")) {
      split(line->substr(4), ',', fields);
      for (const std::string_view field : fields) out.variables.emplace_back(field);
      if (out.variables.size() < 5 || out.variables[0] != "theta_i" || out.variables[1] != "phi_i" || out.variables[2] != "theta_s" ||
          out.variables[3] != "phi_s")
        faults.add_at(lines.number(), excerpt(*line), "VARS theta_i,phi_i,theta_s,phi_s and at least one value");
      return out;
    }
    if (!line->empty() && !line->starts_with("CONVENTION ")) {
      constexpr std::size_t longest = 1000;
      if (out.text.size() < longest) out.text += (out.text.empty() ? "" : "\n") + std::string(line->substr(0, longest));
    }
  }
  faults.add_at(lines.number(), "the end of the file", "VARS theta_i,phi_i,theta_s,phi_s,...");
  return out;
}

Channels channels_of(const std::vector<std::string>& variables, FaultList& faults) {
  Channels out;
  for (std::size_t k = 4; k < variables.size(); ++k) {
    const std::string& name = variables[k];
    Channel channel = single_channel(name).front();
    if (name == "R" || name == "G" || name == "B") channel.name = std::string(1, static_cast<char>(name[0] - 'A' + 'a'));
    if (name.size() > 2 && name.ends_with("nm")) {
      const Number nm = parse_number(std::string_view(name).substr(0, name.size() - 2));
      if (nm.fault == nullptr && nm.value > 0) channel.wavelength_in_nm = channel.wavelength_out_nm = nm.value;
    }
    const bool twice = std::any_of(out.begin(), out.end(), [&](const Channel& other) { return other.name == channel.name; });
    if (channel.name.empty() || twice) faults.add(faults.file(), fmt::format("a variable {}", excerpt(name)), "a name of its own");
    out.push_back(std::move(channel));
  }
  return out;
}

/// The specular direction is at phi_s - phi_i = pi?
bool specular_at_pi(const Header& header, const ReadOptions& options, FaultList& faults) {
  if (header.ours) return true;
  const auto answer = options.assumed("specular");
  if (answer == "pi") return true;
  if (answer != "0")
    faults.add(faults.file(),
               answer ? fmt::format("--assume specular={}", *answer) : "azimuths of which the file does not say where specular is",
               "--assume specular=0 (as in the standard) or specular=pi (Cornell's files, libbsdf, ALTA): phi_s - phi_i there");
  return false;
}

}  // namespace

Dataset read_astm(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const std::string bytes = read_file(path);
  CsvLines lines(bytes);
  const Header header = read_header(lines, faults);
  faults.raise();
  Dataset out;
  out.channels = channels_of(header.variables, faults);
  const bool at_pi = specular_at_pi(header, options, faults);
  const std::string side = options.assumed("side").value_or(header.transmission ? "transmission" : "reflection");
  if (side != "reflection" && side != "transmission")
    faults.add(faults.file(), fmt::format("--assume side={}", side), "reflection or transmission");
  out.side = side == "transmission" ? Side::transmission : Side::reflection;
  faults.raise();

  out.f.resize(out.channels.size());
  std::size_t rows = 0;
  std::vector<std::string_view> fields;
  std::vector<double> numbers(header.variables.size());
  for (auto line = lines.next(); line; line = lines.next()) {
    if (is_empty_line(*line)) continue;
    ++rows;
    split(*line, ',', fields);
    if (fields.size() != numbers.size()) {
      faults.add_at(lines.number(), fmt::format("{} numbers", fields.size()), fmt::format("{}, as VARS says", numbers.size()));
      continue;
    }
    bool sound = true, known = false;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const Number number = parse_number(fields[k]);
      numbers[k] = number.value;
      const bool is_number = number.fault == nullptr && (k >= 4 || !std::isnan(number.value));
      if (!is_number) faults.add_at(lines.number(), excerpt(fields[k]), "a finite number");
      sound = sound && is_number;
      known = known || (k >= 4 && !std::isnan(number.value));
    }
    if (!sound) continue;
    if (!known) {
      ++out.masked.nan;
      continue;
    }
    // Angles written with few digits may lie a little beyond the horizon.
    constexpr double horizon = std::numbers::pi / 2 + 1e-6;
    double theta_s = numbers[2];
    if (std::fabs(numbers[0]) > horizon || (out.side == Side::reflection && std::fabs(theta_s) > horizon) ||
        std::fabs(theta_s) > std::numbers::pi) {
      ++out.masked.below_horizon;
      continue;
    }
    const auto turned = [](Angle phi, bool turn) { return turn ? phi + degrees(180) : phi; };
    const Angle phi_s = turned(radians(numbers[3]), (theta_s < 0) != !at_pi);
    theta_s = std::fabs(theta_s);
    const Angle theta_o = out.side == Side::transmission && theta_s <= horizon ? degrees(180) - radians(theta_s) : radians(theta_s);
    out.angles.push_back({radians(std::fabs(numbers[0])), turned(radians(numbers[1]), numbers[0] < 0), theta_o, phi_s});
    for (std::size_t c = 0; c < out.channels.size(); ++c) out.f[c].push_back(numbers[4 + c]);
  }
  if (header.has_points && header.points != rows)
    faults.add(faults.file(), fmt::format("{} samples", rows), fmt::format("{}, as NUM_POINTS says", header.points));
  if (faults.empty() && out.size() == 0) faults.add(faults.file(), "no sample", "at least one");
  faults.raise();
  out.symmetry = stated_symmetry(path, options);
  if (header.isotropic && !options.assumed("isotropic")) out.symmetry = {.isotropic = true, .bilateral = header.bilateral};
  out.provenance["source"] = path.filename().string();
  if (!header.text.empty()) out.provenance["header"] = header.text;
  return out;
}

bool recognises_astm(std::string_view head, std::uintmax_t) {
  const std::size_t at = head.find("VARS theta_i");
  return at != std::string_view::npos && (at == 0 || head[at - 1] == '\n');
}

Opened open_astm(const std::filesystem::path& path, const ReadOptions& options) {
  Opened out = opened_grid("astm", std::make_shared<const Dataset>(read_astm(path, options)));
  out.info.insert(out.info.begin(), {{"holds", "f, cosine not included"}, {"unit", "1/sr"}, {"nodes", "at samples, in radians"}});
  return out;
}

ExportNotes write_astm(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  notes.files = {path};
  const auto samples = samples_to_write(source, options, notes);
  const bool rgb = samples->channels == rgb_channels();
  std::string rows;
  std::size_t written = 0;
  for (std::size_t k = 0; k < samples->size(); ++k) {
    if (std::all_of(samples->f.begin(), samples->f.end(), [&](const auto& column) { return std::isnan(column[k]); })) continue;
    const GonioAngles& pose = samples->angles[k];
    const auto in_turn = [](Angle phi) {
      const double turn = std::fmod(phi.degrees(), 360.0);
      return turn == phi.degrees() && turn >= 0 ? phi.radians() : degrees(turn < 0 ? turn + 360 : turn).radians();
    };
    const double theta_s = samples->side == Side::transmission ? (degrees(180) - pose.theta_o).radians() : pose.theta_o.radians();
    for (const double angle : {pose.theta_i.radians(), in_turn(pose.phi_i), theta_s, in_turn(pose.phi_o)}) {
      append_number(rows, angle);
      rows += ',';
    }
    for (std::size_t c = 0; c < samples->channels.size(); ++c) {
      append_number(rows, samples->f[c][k]);
      rows += c + 1 == samples->channels.size() ? '\n' : ',';
    }
    ++written;
  }
  std::string variables;
  for (const Channel& channel : samples->channels) {
    std::string name = rgb ? std::string(1, static_cast<char>(channel.name[0] - 'a' + 'A')) : channel.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ',' || c == '"' || c == '#' || static_cast<unsigned char>(c) <= ' '; }, '_');
    variables += "," + name;
  }
  const std::string symmetry =
      !samples->symmetry.isotropic ? "" : fmt::format("{}\n", samples->symmetry.bilateral ? bilateral_line : isotropic_line);
  const std::string text = fmt::format(
      "ASTM E1392, written by gonio from {}\n{}\n{}{}NUM_POINTS {}\nVARS theta_i,phi_i,theta_s,phi_s{}\n{}", source.format, convention_line,
      samples->side == Side::transmission ? std::string(transmission_line) + "\n" : "", symmetry, written, variables, rows);
  notes.facts.emplace_back("angles", "radians; specular at phi_s - phi_i = pi, as libbsdf and ALTA read such files (the standard has 0)");
  if (samples->has_uncertainty()) notes.lost.emplace_back("uncertainties have no place in the format");
  write_file_atomically(path, text);
  return notes;
}

}  // namespace gonio::tabulated
