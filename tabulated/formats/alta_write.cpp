// SPDX-License-Identifier: BSD-3-Clause
// Writing text files of the ALTA library.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/formats/alta.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/samples_to_write.hpp"

namespace gonio::tabulated {
namespace {

std::string header(const Dataset& data, const char* parameterisation, int dimensions) {
  std::string names, segments;
  for (const Channel& channel : data.channels) {
    names += " " + channel.name;
    segments += segments.empty() ? "0" : " 0";
  }
  // A name with a line end in it would begin a row.
  std::replace_if(
      names.begin(), names.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return fmt::format("# f in 1/sr, cosine not included; angles in radians; channels{}\n#DIM {} {}\n#PARAM_IN {}\n#PARAM_OUT {}\n#VS {}\n",
                     names, dimensions, data.channels.size(), parameterisation,
                     data.channels == rgb_channels() ? "RGB_COLOR" : "INV_STERADIAN", segments);
}

ExportNotes write(bool half, const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  const auto data = with_both_sides(samples_to_write(source, options, notes));
  if (data->side == Side::transmission) throw Error(ErrorKind::input, {path.string(), "samples of transmission", "reflection"});
  if (half && !data->symmetry.isotropic)
    throw Error(ErrorKind::input, {path.string(), "samples that are not known to be isotropic", "an isotropic BRDF, or the format alta"});
  const bool isotropic = data->symmetry.isotropic;
  const char* coordinates = half ? "RUSIN_TH_TD_PD" : isotropic ? "ISOTROPIC_TV_TL_DPHI" : "SPHERICAL_TL_PL_TV_PV";
  std::string text = header(*data, coordinates, isotropic ? 3 : 4);
  std::size_t left_out = 0;
  for (std::size_t k = 0; k < data->size(); ++k) {
    if (std::any_of(data->f.begin(), data->f.end(), [&](const std::vector<double>& column) { return std::isnan(column[k]); })) {
      ++left_out;
      continue;
    }
    const GonioAngles& at = data->angles[k];
    const auto add = [&](double number) {
      append_number(text, number);
      text += ' ';
    };
    if (half) {
      const HalfDifference angles = half_difference(at);
      for (const Angle& angle : {angles.theta_h, angles.theta_d, angles.phi_d}) add(angle.radians());
    } else if (isotropic) {
      for (const Angle& angle : {at.theta_o, at.theta_i, at.phi_o - at.phi_i}) add(angle.radians());
    } else {
      for (const Angle& angle : {at.theta_i, at.phi_i, at.theta_o, at.phi_o}) add(angle.radians());
    }
    for (const std::vector<double>& column : data->f) add(column[k]);
    text.back() = '\n';
  }
  if (left_out == data->size()) throw Error(ErrorKind::input, {path.string(), "no sample that is known in every channel", "at least one"});
  write_file_atomically(path, text);
  notes.files = {path};
  notes.facts.emplace_back("coordinates", coordinates);
  if (left_out > 0) notes.lost.push_back(fmt::format("{} samples that are not known in every channel", left_out));
  if (data->has_uncertainty()) notes.lost.emplace_back("uncertainties have no place in the format");
  return notes;
}

}  // namespace

ExportNotes write_alta(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(false, source, path, options);
}
ExportNotes write_alta_half(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(true, source, path, options);
}

}  // namespace gonio::tabulated
