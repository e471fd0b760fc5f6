// SPDX-License-Identifier: BSD-3-Clause
// Writing tabular scatter files of Zemax OpticStudio.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/zemax.hpp"
#include "tabulated/formats/zemax_set.hpp"
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

/// A table of the source on a grid of the format, and what is to be said of it.
ZemaxTable table_of(const Opened& source, const ChannelMap& map, const WriteOptions& options, ExportNotes& notes) {
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
  if (grid.rotation_deg.size() > 1) notes.facts.emplace_back("reader", "older versions of OpticStudio take one sample rotation only");
  if (notes.n_below_horizon > 0) notes.lost.emplace_back("nodes beyond the horizon are 0");
  if (notes.n_unknown + notes.n_negative > 0) notes.lost.emplace_back("unknown and negative values are 0");
  if (source.uncertain || (source.dataset && source.dataset->has_uncertainty()))
    notes.lost.emplace_back("uncertainties have no place in the format");
  return {std::move(grid), map.to, std::move(values), std::move(remarks)};
}

/// The channel alone, its wavelength in a comment.
ZemaxTable channel_of(const ZemaxTable& table, std::size_t c) {
  ZemaxRemarks remarks{table.remarks().comments, {table.remarks().tis[c]}};
  if (table.channels()[c].wavelength_in_nm)
    remarks.comments.push_back(fmt::format(" {}{}", zemax_wavelength_comment, *table.channels()[c].wavelength_in_nm));
  return {table.grid(), {table.channels()[c]}, {table.values()[c]}, std::move(remarks)};
}

void note_wavelength(ExportNotes& notes) { notes.facts.emplace_back("wavelength", "in a comment: the format has no place for it"); }

void note_long_names(ExportNotes& notes) {
  constexpr std::size_t longest_name = 60;
  for (const std::filesystem::path& file : notes.files)
    if (file.filename().string().size() > longest_name) {
      notes.facts.emplace_back("reader", "OpticStudio takes names of at most 60 characters: rename the file");
      return;
    }
}

void require_evaluable(const Opened& source, const std::filesystem::path& path) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
}

/// The source as a table that one file can hold: a single channel, or X, Y, Z.
const ZemaxTable* own_table(const Opened& source) {
  const auto* table = dynamic_cast<const ZemaxTable*>(source.brdf.get());
  if (table == nullptr || table->channels().size() == 1) return table;
  const Channels& channels = table->channels();
  return channels.size() == 3 && channels[0].name == "X" && channels[1].name == "Y" && channels[2].name == "Z" ? table : nullptr;
}

void note_own_table(const Opened& source, const ZemaxTable& table, ExportNotes& notes) {
  notes.n_nodes = table.grid().size();
  notes.n_below_horizon = source.masked.below_horizon;
  notes.facts = {{"grid", grid_words(table.grid())},
                 {"values", "those of the source file, unchanged"},
                 {"TIS", "those of the source file; of the file / integral of f cos theta_o: " + tis_difference(table)}};
}

}  // namespace

ExportNotes write_zemax(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  notes.files = {path};
  note_long_names(notes);
  if (const ZemaxTable* table = own_table(source)) {
    note_own_table(source, *table, notes);
    write_file_atomically(path, text_of(*table, table->remarks()));
    return notes;
  }
  require_evaluable(source, path);
  const ChannelMap map = one_channel_or_xyz(source.brdf->channels());
  ZemaxTable table = table_of(source, map, options, notes);
  if (map.to.size() > 1)
    notes.facts.emplace_back("reader", "OpticStudio takes X, Y and Z as three monochrome tables and asks which one to use");
  if (map.to.size() == 1 && map.to[0].wavelength_in_nm) note_wavelength(notes);
  if (map.to.size() == 1) table = channel_of(table, 0);
  write_file_atomically(path, text_of(table, table.remarks()));
  return notes;
}

ExportNotes write_zemax_set(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  require_evaluable(source, path);
  const Channels channels = source.brdf->channels();
  if (channels.size() == 1) return write_zemax(source, path, options);
  ExportNotes notes;
  const auto* own = dynamic_cast<const ZemaxTable*>(source.brdf.get());
  if (own != nullptr) note_own_table(source, *own, notes);
  ChannelMap same{channels, std::vector<double>(channels.size() * channels.size()), ""};
  for (std::size_t c = 0; c < channels.size(); ++c) same.weights[c * channels.size() + c] = 1;
  const ZemaxTable table = own != nullptr ? *own : table_of(source, same, options, notes);

  const std::vector<std::filesystem::path> files = zemax_set_files(path, channels);
  std::vector<std::string> texts;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const ZemaxTable one = channel_of(table, c);
    ZemaxSetPlace place{c + 1, channels.size(), channels[c].name, {}};
    for (const std::filesystem::path& file : files) place.files.push_back(file.filename().string());
    ZemaxRemarks remarks = one.remarks();
    for (const std::string& comment : zemax_set_comments(place)) remarks.comments.push_back(comment);
    texts.push_back(text_of(one, remarks));
  }
  try {
    for (std::size_t c = 0; c < files.size(); ++c) {
      write_file_atomically(files[c], texts[c]);
      notes.files.push_back(files[c]);
    }
  } catch (...) {
    std::error_code ignored;
    for (const std::filesystem::path& file : notes.files) std::filesystem::remove(file, ignored);
    throw;
  }
  note_long_names(notes);
  notes.facts.emplace_back("files",
                           fmt::format("{}, one per channel, each monochrome; gonio reads the set from any of them", files.size()));
  notes.facts.emplace_back("reader", "OpticStudio scatters with the one file a surface names: a run per channel");
  if (std::any_of(channels.begin(), channels.end(), [](const Channel& channel) { return channel.wavelength_in_nm.has_value(); }))
    note_wavelength(notes);
  else
    notes.lost.emplace_back("which wavelength a channel stands for: the files name the channel in a comment");
  return notes;
}

}  // namespace gonio::tabulated
