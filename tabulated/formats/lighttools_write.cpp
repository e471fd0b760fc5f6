// SPDX-License-Identifier: BSD-3-Clause
// Writing tabular scatter files of LightTools.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/lighttools.hpp"
#include "tabulated/total_scatter.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr double phi_i_deg = 90;

void append_list(std::string& text, const char* keyword, const std::vector<double>& values) {
  text += fmt::format("{}\t{}\n", keyword, values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) text += '\t';
    append_number(text, values[k]);
  }
  text += '\n';
}

}  // namespace

ExportNotes write_lighttools(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  if (!source.brdf->symmetry().isotropic)
    throw Error(ErrorKind::input,
                {path.string(), "an anisotropic source", "an isotropic one: how planes of incidence turn in the format is not published"});
  ExportNotes notes;
  notes.files = {path};
  const Side side = source.side;
  std::optional<DirectionGrid> own = source.dataset ? grid_of_samples(*source.dataset) : std::nullopt;
  const DirectionGrid grid = own ? *own : direction_grid(options.size, {true, false, false});
  // Azimuths of wo where the light is at 90°, from 0 on.
  std::vector<double> azimuths;
  for (const double phi : grid.phi_deg) azimuths.push_back(phi + phi_i_deg < 360 ? phi + phi_i_deg : phi + phi_i_deg - 360);
  std::sort(azimuths.begin(), azimuths.end());

  std::vector<GonioAngles> poses;
  for (const double theta_i : grid.theta_i_deg)
    for (const double azimuth : azimuths)
      for (const double theta : grid.theta_o_deg)
        poses.push_back(
            {degrees(theta_i), degrees(phi_i_deg), degrees(side == Side::transmission ? 180 - theta : theta), degrees(azimuth)});
  const ChannelMap map = one_channel_or_xyz(source.brdf->channels());
  const auto values = values_to_write(source, poses, map, options.threads, notes);

  std::string text = fmt::format("# written by gonio from {}\nSymmetry\tAsymmetric\nSpectralContent\t{}\n", source.format,
                                 map.to.size() == 1 ? "Monochrome" : "XYZ");
  append_list(text, "ScatterAzimuth", azimuths);
  append_list(text, "ScatterRadial", grid.theta_o_deg);
  text += "\nDataBegin\n";
  const std::size_t block = azimuths.size() * grid.theta_o_deg.size();
  std::vector<double> tis(map.to.size());
  for (std::size_t i = 0; i < grid.theta_i_deg.size(); ++i) {
    map.apply(total_scatter(*source.brdf, degrees(grid.theta_i_deg[i]), degrees(phi_i_deg), side).data(), tis.data());
    for (std::size_t c = 0; c < map.to.size(); ++c) {
      text += "AOI\t";
      append_number(text, grid.theta_i_deg[i]);
      text += "\nPOI\t0\nSide\tFront\n";
      if (map.to[c].wavelength_in_nm) text += fmt::format("Wavelength\t{}\n", *map.to[c].wavelength_in_nm);
      text += fmt::format("ScatterType\t{}\n", side == Side::reflection ? "BRDF" : "BTDF");
      if (map.to.size() > 1) text += fmt::format("TristimulusValue\tTris{}\n", "XYZ"[c]);
      text += "TIS\t";
      append_number(text, in_float_digits(std::max(tis[c], 0.0)));
      text += '\n';
      for (std::size_t k = 0; k < block; ++k) {
        const double value = values[c][i * block + k];
        append_number(text, value > 0 ? value : 0);  // NaN is not > 0
        text += (k + 1) % grid.theta_o_deg.size() == 0 ? '\n' : '\t';
      }
    }
  }
  text += "DataEnd\n";
  notes.facts.emplace_back("grid", fmt::format("{} incidences x {} azimuths x {} radial angles{}", grid.theta_i_deg.size(), azimuths.size(),
                                               grid.theta_o_deg.size(), own ? ", those of the source" : ""));
  notes.facts.emplace_back("angles", "absolute; the light at azimuth 90 deg, as libbsdf reads such files");
  notes.facts.emplace_back("TIS", "integral of f cos theta_o over the hemisphere of the source");
  notes.lost.emplace_back("not tried with LightTools itself; mind that Zemax files have the same extension and key words but other angles");
  if (notes.n_unknown + notes.n_negative > 0) notes.lost.emplace_back("unknown and negative values are 0");
  write_file_atomically(path, text);
  return notes;
}

}  // namespace gonio::tabulated
