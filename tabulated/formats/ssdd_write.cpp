// SPDX-License-Identifier: BSD-3-Clause
// Writing .ssdd.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/direction_grid.hpp"
#include "tabulated/formats/ssdd.hpp"
#include "tabulated/lattice_values.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

std::vector<double> even(double last, std::size_t count) {
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(last * static_cast<double>(k) / static_cast<double>(count - 1));
  return out;
}

/// Even steps of the square root, as MERL has them: theta_h = 90° (k/n)².
std::vector<double> squares(std::size_t count) {
  std::vector<double> out;
  for (const double root : even(1, count)) out.push_back(90 * root * root);
  return out;
}

/// How many steps in what.
struct Counts {
  std::size_t half, difference, azimuth;
};

Counts counts_of(GridSize size) {
  switch (size) {
    case GridSize::paper: return {31, 16, 13};
    case GridSize::standard: return {61, 31, 37};
    case GridSize::fine: break;
  }
  return {121, 46, 73};
}

Lattice grid_of(LatticeCoordinates coordinates, const Opened& source, GridSize size) {
  const Symmetry symmetry = source.brdf->symmetry();
  // A fourth angle costs a factor of twelve and more.
  if (!symmetry.isotropic) size = size == GridSize::fine ? GridSize::standard : GridSize::paper;
  const Counts counts = counts_of(size);
  Lattice out;
  out.coordinates = coordinates;
  out.side = source.side;
  out.bilateral = symmetry.isotropic && symmetry.bilateral;
  const DirectionGrid directions = direction_grid(size, symmetry);
  // Full turns with both ends, as the examples of the document have them.
  const std::vector<double> turn = out.bilateral ? even(180, counts.azimuth) : even(360, 2 * counts.azimuth - 1);
  const std::vector<double> incidence = symmetry.isotropic ? std::vector<double>{0} : even(360, 25);
  switch (coordinates) {
    case LatticeCoordinates::spherical: {
      std::vector<double> azimuths = directions.phi_deg;
      if (!out.bilateral) azimuths.push_back(360);
      out.nodes_deg = {directions.theta_i_deg, incidence, directions.theta_o_deg, azimuths};
      break;
    }
    case LatticeCoordinates::specular: out.nodes_deg = {directions.theta_i_deg, incidence, radial_grid_deg(size), turn}; break;
    case LatticeCoordinates::distorted: out.nodes_deg = {directions.theta_i_deg, incidence, squares(counts.half), turn}; break;
    case LatticeCoordinates::beta: break;  // SSDD has no such coordinates
    case LatticeCoordinates::half_difference: out.nodes_deg = {squares(counts.half), incidence, even(90, counts.difference), turn}; break;
  }
  return out;
}

/// What the channels are called, and how they are mapped where the format has no name for them.
struct Colours {
  const char* model;
  ChannelMap map;
};

Colours colours_of(const Channels& channels) {
  ChannelMap same{channels, {}, ""};
  for (std::size_t to = 0; to < channels.size(); ++to)
    for (std::size_t from = 0; from < channels.size(); ++from) same.weights.push_back(to == from ? 1 : 0);
  bool spectral = !channels.empty();
  for (std::size_t c = 0; c < channels.size(); ++c)
    spectral = spectral && channels[c].wavelength_in_nm && (c == 0 || *channels[c].wavelength_in_nm > *channels[c - 1].wavelength_in_nm);
  const auto named = [&](const char* a, const char* b, const char* c) {
    return channels.size() == 3 && channels[0].name == a && channels[1].name == b && channels[2].name == c;
  };
  if (spectral) return {"spectrum", same};
  if (channels.size() == 1) return {"monochrome", same};
  if (named("X", "Y", "Z")) return {"xyz", same};
  if (named("r", "g", "b")) return {"rgb", same};
  return {"rgb", map_to_rgb(channels)};
}

std::string list(const char* key, const std::vector<double>& numbers) { return fmt::format("{} {}\n", key, fmt::join(numbers, " ")); }

ExportNotes write(LatticeCoordinates coordinates, bool binary, const Opened& source, const std::filesystem::path& path,
                  const WriteOptions& options) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  ExportNotes notes;
  const auto* own = source.format == "ssdd" ? dynamic_cast<const LatticeTable*>(source.brdf.get()) : nullptr;
  const Lattice lattice =
      own != nullptr && own->lattice().coordinates == coordinates ? own->lattice() : grid_of(coordinates, source, options.size);
  const Colours colours = colours_of(source.brdf->channels());
  std::vector<std::vector<double>> values = lattice_values(source, lattice, colours.map, options.threads, notes);
  if (fill_unknown(lattice, values) > 0) notes.lost.emplace_back("nodes beyond the horizon and unknown ones repeat their neighbour");

  constexpr const char* types[] = {"spherical", "specular", "half_difference", "distorted_spherical"};
  std::string text = fmt::format("VERSION 0.3\nSOFTWARE gonio\n\nDATA_TYPE {}\nCOLOR_MODEL {}\n",
                                 lattice.side == Side::transmission ? "btdf" : "brdf", colours.model);
  if (std::string_view(colours.model) == "spectrum") {
    std::vector<double> wavelengths;
    for (const Channel& channel : colours.map.to) wavelengths.push_back(*channel.wavelength_in_nm);
    text += list("WAVELENGTH_LIST", wavelengths);
  }
  text += fmt::format("PARAM_TYPE {}_coordinate_system\n", types[static_cast<int>(coordinates)]);
  if (lattice.bilateral || lattice.reciprocal)
    text += fmt::format("REDUCTION_TYPE{}{}\n", lattice.bilateral ? " bilateral_symmetry" : "", lattice.reciprocal ? " reciprocity" : "");
  text += list("PARAM0_LIST", lattice.nodes_deg[0]);
  if (lattice.nodes_deg[1].size() > 1) text += list("PARAM1_LIST", lattice.nodes_deg[1]);
  text += list("PARAM2_LIST", lattice.nodes_deg[2]) + list("PARAM3_LIST", lattice.nodes_deg[3]);
  if (!lattice.offset_deg.empty()) text += list("PARAM4_LIST", lattice.offset_deg);
  text +=
      fmt::format("SOURCE_TYPE {}\nDATA {}\n", source.dataset && !source.simulated ? "measured" : "generated", binary ? "binary" : "ascii");
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    for (std::size_t c = 0; c < values.size(); ++c) {
      // Readers hold floats.
      const auto value = static_cast<float>(values[c][node]);
      if (std::isinf(value)) throw Error(ErrorKind::input, {path.string(), fmt::format("{}", values[c][node]), "values that fit a float"});
      if (binary)
        text.append(reinterpret_cast<const char*>(&value), sizeof value);
      else
        text += fmt::format("{}{}", c == 0 ? "" : " ", value);
    }
    if (!binary) text += '\n';
  }
  write_file_atomically(path, text);
  notes.files = {path};
  notes.facts.emplace_back(
      "grid", fmt::format("{} x {} x {} x {} angles in {} coordinates", lattice.nodes_deg[0].size(), lattice.nodes_deg[1].size(),
                          lattice.nodes_deg[2].size(), lattice.nodes_deg[3].size(), types[static_cast<int>(coordinates)]));
  if (source.uncertain || (source.dataset && source.dataset->has_uncertainty()))
    notes.lost.emplace_back("uncertainties have no place in the format");
  if (own != nullptr)
    for (const auto& [key, value] : source.info)
      if (key.starts_with("specular_")) notes.lost.push_back(fmt::format("the {} of the source file", key));
  return notes;
}

}  // namespace

ExportNotes write_ssdd(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  // A file of this format keeps its coordinates.
  const auto* own = source.format == "ssdd" ? dynamic_cast<const LatticeTable*>(source.brdf.get()) : nullptr;
  return write(own != nullptr ? own->lattice().coordinates : LatticeCoordinates::half_difference, false, source, path, options);
}
ExportNotes write_ssdd_binary(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  const auto* own = source.format == "ssdd" ? dynamic_cast<const LatticeTable*>(source.brdf.get()) : nullptr;
  return write(own != nullptr ? own->lattice().coordinates : LatticeCoordinates::half_difference, true, source, path, options);
}
ExportNotes write_ssdd_spherical(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(LatticeCoordinates::spherical, false, source, path, options);
}
ExportNotes write_ssdd_specular(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(LatticeCoordinates::specular, false, source, path, options);
}
ExportNotes write_ssdd_distorted(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(LatticeCoordinates::distorted, false, source, path, options);
}

}  // namespace gonio::tabulated
