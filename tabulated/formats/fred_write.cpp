// SPDX-License-Identifier: BSD-3-Clause
// Writing tabulated scatter of FRED.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/fred.hpp"
#include "tabulated/specular_poses.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

/// One line of the file, angles in degrees.
struct Line {
  double theta_spec, phi_spec, theta, phi, f;
};

double in_turn(double degrees) {
  // Azimuths that went through radians differ in their last digits.
  constexpr double digits = 1e9;
  const double rounded = std::round(std::fmod(degrees, 360.0) * digits) / digits;
  return rounded < 0 ? rounded + 360 : rounded >= 360 ? rounded - 360 : rounded;
}

/// In the plane of incidence FRED takes signed zenith angles at the azimuth of the specular direction.
bool to_signed(std::vector<Line>& lines) {
  for (const Line& line : lines) {
    const double from_specular = in_turn(line.phi - line.phi_spec);
    if (line.theta != 0 && from_specular != 0 && from_specular != 180) return false;
  }
  for (Line& line : lines) {
    if (in_turn(line.phi - line.phi_spec) == 180) line.theta = -line.theta;
    line.phi = line.phi_spec;
  }
  return true;
}

}  // namespace

ExportNotes write_fred(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  ExportNotes notes;
  notes.files = {path};
  const Side side = source.side;
  const bool isotropic = source.brdf->symmetry().isotropic;
  const std::vector<GonioAngles> poses = source.dataset ? source.dataset->angles : specular_poses(source, options);
  const auto values = values_to_write(source, poses, one_channel(source.brdf->channels()), options.threads, notes);

  std::vector<Line> lines;
  std::size_t left_out = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (!(values[0][k] > 0)) {  // NaN is not > 0
      ++left_out;
      continue;
    }
    const double phi_spec = isotropic ? 0 : in_turn(poses[k].phi_i.degrees() + 180);
    const double phi = isotropic ? in_turn(poses[k].phi_o.degrees() - poses[k].phi_i.degrees() - 180) : in_turn(poses[k].phi_o.degrees());
    const double theta = side == Side::transmission ? 180 - poses[k].theta_o.degrees() : poses[k].theta_o.degrees();
    lines.push_back({poses[k].theta_i.degrees(), phi_spec, theta, phi, values[0][k]});
  }
  if (lines.empty()) throw Error(ErrorKind::input, {path.string(), "no positive value", "at least one"});
  const bool in_plane = to_signed(lines);
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::tie(a.theta_spec, a.phi_spec, a.theta, a.phi) < std::tie(b.theta_spec, b.phi_spec, b.theta, b.phi);
  });
  std::string text = "type bsdf_data\nformat angles=deg bsdf=value scale=1\n";
  std::size_t incidences = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto append = [&](std::initializer_list<double> numbers) {
      for (const double& number : numbers) {
        append_number(text, number);
        text += &number + 1 == numbers.end() ? '\n' : '\t';
      }
    };
    if (k == 0 || lines[k].theta_spec != lines[k - 1].theta_spec || lines[k].phi_spec != lines[k - 1].phi_spec) {
      append({lines[k].theta_spec, lines[k].phi_spec});
      ++incidences;
    }
    append({lines[k].theta, lines[k].phi, lines[k].f});
  }
  notes.facts.emplace_back("grid", fmt::format("{} specular directions, {} samples{}{}", incidences, lines.size(),
                                               source.dataset ? ", those of the source" : "", in_plane ? ", in plane" : ""));
  notes.facts.emplace_back("angles", "specular direction instead of wi: phi_i is half a turn from it");
  if (left_out > 0) notes.lost.push_back(fmt::format("{} unknown or not positive values are left out: FRED wants positive ones", left_out));
  if (!isotropic) notes.lost.emplace_back("FRED's tabulated model is isotropic: it does not use the orientation that the file keeps");
  if (side == Side::transmission) notes.lost.emplace_back("the file does not say that it is transmission: choose it in the scatter model");
  if (source.brdf->channels().size() == 1 && source.brdf->channels()[0].wavelength_in_nm)
    notes.lost.emplace_back("the wavelength has no place in the format");
  write_file_atomically(path, text);
  return notes;
}

}  // namespace gonio::tabulated
