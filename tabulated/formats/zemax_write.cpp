// SPDX-License-Identifier: BSD-3-Clause
// Writing tabular scatter files of Zemax OpticStudio.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/zemax.hpp"
#include "tabulated/radial_grid.hpp"
#include "tabulated/total_scatter.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

void append_list(std::string& text, const char* keyword, const std::vector<double>& values) {
  text += fmt::format("{}\t{}\n", keyword, values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) text += '\t';
    append_number(text, values[k]);
  }
  text += '\n';
}

std::string text_of(const SpecularTable& table, const ZemaxRemarks& remarks) {
  const SpecularGrid& grid = table.grid();
  std::string text;
  for (const std::string& comment : remarks.comments) text += fmt::format("#{}\n", comment);
  const bool anisotropic = grid.rotation_deg.size() > 1;
  text += fmt::format("Source\tMeasured\nSymmetry\t{}\nSpectralContent\t{}\nScatterType\t{}\n",
                      grid.mirrored ? "PlaneSymmetrical"
                      : anisotropic ? "ASymmetrical4D"
                                    : "Asymmetrical",
                      table.channels().size() == 1 ? "Monochrome" : "XYZ", grid.side == Side::reflection ? "BRDF" : "BTDF");
  append_list(text, "SampleRotation", grid.rotation_deg);
  append_list(text, "AngleOfIncidence", grid.incidence_deg);
  append_list(text, "ScatterAzimuth", grid.azimuth_deg);
  append_list(text, "ScatterRadial", grid.radial_deg);
  text += '\n';
  for (std::size_t c = 0; c < table.channels().size(); ++c) {
    text += table.channels().size() == 1 ? std::string("Monochrome\n") : fmt::format("Tristimulus{}\n", "XYZ"[c]);
    text += "DataBegin\n";
    std::size_t at = 0;
    for (const double tis : remarks.tis[c]) {
      text += "TIS\t";
      append_number(text, tis);
      text += '\n';
      for (std::size_t a = 0; a < grid.azimuth_deg.size(); ++a)
        for (std::size_t r = 0; r < grid.radial_deg.size(); ++r) {
          append_number(text, table.values()[c][at++]);
          text += r + 1 == grid.radial_deg.size() ? '\n' : '\t';
        }
    }
    text += "DataEnd\n";
  }
  return text;
}

std::string grid_words(const SpecularGrid& grid) {
  return fmt::format("{} rotations x {} incidences x {} azimuths x {} radial angles", grid.rotation_deg.size(), grid.incidence_deg.size(),
                     grid.azimuth_deg.size(), grid.radial_deg.size());
}

/// The largest difference between the TIS of a file and that of its values, in words.
std::string tis_difference(const ZemaxTable& table) {
  std::string out;
  const SpecularGrid& grid = table.grid();
  for (std::size_t i = 0; i < grid.incidence_deg.size(); ++i) {
    const Angle phi_i = grid.angles(0, i, 0, 0).phi_i;
    out += fmt::format("{}{:.4g} / {:.4g} at {} deg", i == 0 ? "" : ", ", table.remarks().tis[0][i],
                       total_scatter(table, degrees(grid.incidence_deg[i]), phi_i, grid.side)[0], grid.incidence_deg[i]);
  }
  return out;
}

SpecularGrid grid_for(const Opened& source, const WriteOptions& options) {
  SpecularGrid grid;
  const Symmetry symmetry = source.brdf->symmetry();
  grid.side = source.side;
  grid.mirrored = symmetry.isotropic && symmetry.bilateral;
  const double step = options.size == GridSize::paper ? 15 : options.size == GridSize::standard ? 10 : 5;
  grid.rotation_deg = symmetry.isotropic ? std::vector<double>{0} : even_angles(0, 360, options.size == GridSize::fine ? 10 : 30);
  grid.incidence_deg = incidence_grid(options.size);
  grid.azimuth_deg = even_angles(0, grid.mirrored ? 180 : 360, step);
  const std::size_t radials = options.size == GridSize::paper ? 32 : options.size == GridSize::standard ? 64 : 128;
  grid.radial_deg = radial_grid(source, grid.incidence_deg, grid.side, radials, options.threads);
  return grid;
}

}  // namespace

ExportNotes write_zemax(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  notes.files = {path};
  if (const auto* table = dynamic_cast<const ZemaxTable*>(source.brdf.get())) {
    notes.n_nodes = table->grid().size();
    notes.n_below_horizon = source.masked.below_horizon;
    notes.facts = {{"grid", grid_words(table->grid())},
                   {"values", "those of the source file, unchanged"},
                   {"TIS", "those of the source file; of the file / integral of f cos theta_o: " + tis_difference(*table)}};
    write_file_atomically(path, text_of(*table, table->remarks()));
    return notes;
  }
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  const ChannelMap map = one_channel_or_xyz(source.brdf->channels());
  SpecularGrid grid = grid_for(source, options);

  std::vector<GonioAngles> poses;
  std::vector<std::size_t> index;
  for (std::size_t p = 0; p < grid.rotation_deg.size(); ++p)
    for (std::size_t i = 0; i < grid.incidence_deg.size(); ++i)
      for (std::size_t a = 0; a < grid.azimuth_deg.size(); ++a)
        for (std::size_t r = 0; r < grid.radial_deg.size(); ++r) {
          const GonioAngles node = grid.angles(p, i, a, r);
          if (grid.beyond_horizon(node)) continue;
          poses.push_back(node), index.push_back(grid.index(p, i, a, r));
        }
  notes.n_below_horizon = grid.size() - index.size();
  const auto known = values_to_write(source, poses, map, options.threads, notes);
  std::vector<std::vector<double>> values(map.to.size(), std::vector<double>(grid.size(), 0.0));
  for (std::size_t c = 0; c < known.size(); ++c)
    for (std::size_t k = 0; k < index.size(); ++k) values[c][index[k]] = known[c][k] > 0 ? known[c][k] : 0;  // NaN is not > 0
  ZemaxRemarks remarks;
  remarks.comments = {fmt::format(" written by gonio from {}", source.format)};
  if (grid.rotation_deg.size() > 1) remarks.comments.emplace_back(zemax_rotation_comment);
  if (map.to.size() == 1 && map.to[0].wavelength_in_nm)
    remarks.comments.push_back(fmt::format(" {}{}", zemax_wavelength_comment, *map.to[0].wavelength_in_nm));
  remarks.tis.resize(map.to.size());
  std::vector<double> mapped(map.to.size());
  for (std::size_t p = 0; p < grid.rotation_deg.size(); ++p)
    for (const double incidence : grid.incidence_deg) {
      const Angle phi_i = grid.angles(p, 0, 0, 0).phi_i;
      map.apply(total_scatter(*source.brdf, degrees(incidence), phi_i, grid.side).data(), mapped.data());
      for (std::size_t c = 0; c < mapped.size(); ++c) remarks.tis[c].push_back(in_float_digits(std::max(mapped[c], 0.0)));
    }
  notes.facts.emplace_back("grid", grid_words(grid));
  notes.facts.emplace_back("angles", "about the specular direction: radial 0 is specular, azimuth 0 towards the normal, counter-clockwise");
  notes.facts.emplace_back("TIS", "integral of f cos theta_o over the hemisphere of the source");
  if (map.to.size() > 1)
    notes.facts.emplace_back("reader", "OpticStudio takes X, Y and Z as three monochrome tables and asks which one to use");
  if (grid.rotation_deg.size() > 1) notes.facts.emplace_back("reader", "older versions of OpticStudio take one sample rotation only");
  if (notes.n_below_horizon > 0) notes.lost.emplace_back("nodes beyond the horizon are 0");
  if (notes.n_unknown + notes.n_negative > 0) notes.lost.emplace_back("unknown and negative values are 0");
  if (map.to.size() == 1 && map.to[0].wavelength_in_nm)
    notes.facts.emplace_back("wavelength", "in a comment: the format has no place for it");
  write_file_atomically(path, text_of(SpecularTable(std::move(grid), map.to, std::move(values)), remarks));
  return notes;
}

}  // namespace gonio::tabulated
