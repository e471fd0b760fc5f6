// SPDX-License-Identifier: BSD-3-Clause
// Writing scatter files of Ansys SPEOS.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/speos.hpp"
#include "tabulated/polar_integral.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

void append_line(std::string& text, const std::vector<double>& values) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) text += '\t';
    append_number(text, values[k]);
  }
  text += '\n';
}

}  // namespace

ExportNotes write_speos(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  if (!source.brdf->symmetry().isotropic)
    throw Error(ErrorKind::input, {path.string(), "an anisotropic source", "an isotropic one: a .brdf has no orientation"});
  ExportNotes notes;
  notes.files = {path};
  const Side side = source.side;
  const std::optional<DirectionGrid> own = source.dataset ? grid_of_samples(*source.dataset) : std::nullopt;
  const DirectionGrid grid = own ? *own : direction_grid(options.size, {true, false, false});
  if (grid.theta_i_deg.size() < 2)
    throw Error(ErrorKind::input, {path.string(), "samples at one incidence", "at least two: SPEOS wants that many"});
  std::vector<double> azimuths;  // from the specular side
  for (const double phi : grid.phi_deg) azimuths.push_back(phi >= 180 ? phi - 180 : phi + 180);
  std::sort(azimuths.begin(), azimuths.end());
  if (azimuths.front() == 0) azimuths.push_back(360);
  std::vector<double> thetas = grid.theta_o_deg;
  if (side == Side::transmission) {
    for (double& theta : thetas) theta = 180 - theta;
    std::reverse(thetas.begin(), thetas.end());
  }
  std::vector<GonioAngles> poses;
  for (const double theta_i : grid.theta_i_deg)
    for (const double theta : thetas)
      for (const double azimuth : azimuths)
        poses.push_back({degrees(theta_i), 0_deg, degrees(theta), degrees(azimuth < 180 ? azimuth + 180 : azimuth - 180)});

  const bool named = source.brdf->channels().size() == 1 && source.brdf->channels()[0].wavelength_in_nm;
  const ChannelMap map = named ? one_channel(source.brdf->channels()) : map_to_spectrum(source.brdf->channels());
  auto values = values_to_write(source, poses, map, options.threads, notes);
  for (auto& column : values)
    for (double& value : column) value = value > 0 ? value : 0;  // NaN is not > 0

  std::string text = fmt::format("OPTIS - brdf surface file v9.0\n0\nwritten by gonio from {}\n0\n\n{}\n1\n{}\t{}\n", source.format,
                                 side == Side::reflection ? "1\t0" : "0\t1", grid.theta_i_deg.size(), map.to.size());
  append_line(text, grid.theta_i_deg);
  std::vector<double> nm;
  for (const Channel& channel : map.to) nm.push_back(named ? *channel.wavelength_in_nm : *channel.wavelength_out_nm);
  append_line(text, nm);
  const std::size_t block = thetas.size() * azimuths.size();
  for (std::size_t i = 0; i < grid.theta_i_deg.size(); ++i)
    for (const auto& column : values) {
      const std::span<const double> f = std::span(column).subspan(i * block, block);
      append_line(text, {in_float_digits(100 * polar_integral(thetas, azimuths, f))});
      text += fmt::format("{}\t{}\n\t", thetas.size(), azimuths.size());
      append_line(text, azimuths);
      for (std::size_t t = 0; t < thetas.size(); ++t) {
        std::vector<double> row{thetas[t]};
        row.insert(row.end(), f.begin() + static_cast<std::ptrdiff_t>(t * azimuths.size()),
                   f.begin() + static_cast<std::ptrdiff_t>((t + 1) * azimuths.size()));
        append_line(text, row);
      }
    }
  text += "End of file\n";
  notes.facts.emplace_back("grid", fmt::format("{} incidences x {} zenith angles x {} azimuths x {} wavelengths{}", grid.theta_i_deg.size(),
                                               thetas.size(), azimuths.size(), nm.size(), own ? ", angles of the source" : ""));
  notes.facts.emplace_back("angles", "azimuth 0 on the specular side");
  notes.facts.emplace_back("percentages", "integrals of the tables themselves, so that they are taken as they are");
  notes.lost.emplace_back("untested: not tried with SPEOS itself");
  if (notes.n_unknown + notes.n_negative > 0) notes.lost.emplace_back("unknown and negative values are 0");
  write_file_atomically(path, text);
  return notes;
}

}  // namespace gonio::tabulated
