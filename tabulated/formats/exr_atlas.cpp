// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/exr_atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "brdf/error.hpp"
#include "tabulated/describe.hpp"
#include "tabulated/direction_grid.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/brdf_exr_channels.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/exr_image.hpp"
#include "tabulated/lattice_values.hpp"
#include "tabulated/opened_samples.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr const char* unit = "1/sr, cosine not included";
constexpr const char* coordinate_names[] = {"spherical", "specular", "half_difference"};

std::vector<double> even(double last, std::size_t count) {
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(last * static_cast<double>(k) / static_cast<double>(count - 1));
  return out;
}

/// Pixels per side of a tile.
std::size_t tile_size(GridSize size) { return size == GridSize::paper ? 32 : size == GridSize::standard ? 64 : 128; }

Lattice lattice_of(LatticeCoordinates coordinates, const Opened& source, GridSize size) {
  const Symmetry symmetry = source.brdf->symmetry();
  const std::size_t side = tile_size(size);
  Lattice out;
  out.coordinates = coordinates;
  out.bilateral = symmetry.bilateral;
  const std::vector<double> tiles = out.bilateral ? even(180, side / 4 + 1) : even(360, side / 2 + 1);
  if (coordinates == LatticeCoordinates::spherical) {
    const DirectionGrid directions = direction_grid(size, symmetry);
    out.nodes_deg = {directions.theta_o_deg, {0}, directions.theta_o_deg, directions.phi_deg};
    if (!out.bilateral) out.nodes_deg[3].push_back(360);
    return out;
  }
  std::vector<double> half = even(1, side);
  for (double& root : half) root = 90 * root * root;
  out.nodes_deg = {half, {0}, even(90, side), tiles};
  return out;
}

std::string joined(const std::vector<double>& numbers) { return fmt::format("{}", fmt::join(numbers, " ")); }

std::size_t pixel(const Lattice& lattice, std::size_t node) {
  const std::array<std::size_t, 4> at = lattice.position(node);
  return (at[3] * lattice.nodes_deg[2].size() + at[2]) * lattice.nodes_deg[0].size() + at[0];
}

std::vector<float> floats(const std::vector<double>& values, const std::filesystem::path& path) {
  std::vector<float> out;
  for (const double value : values) {
    out.push_back(static_cast<float>(value));
    if (std::isinf(out.back())) throw Error(ErrorKind::input, {path.string(), fmt::format("{}", value), "values that fit a float"});
  }
  return out;
}

/// The channels as they are: the picture has a name for each.
ChannelMap same(const Channels& channels) {
  ChannelMap out{channels, std::vector<double>(channels.size() * channels.size()), ""};
  for (std::size_t c = 0; c < channels.size(); ++c) out.weights[c * channels.size() + c] = 1;
  return out;
}

void require_evaluable(const Opened& source, const std::filesystem::path& path) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
}

ExportNotes write(LatticeCoordinates coordinates, const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  require_evaluable(source, path);
  ExportNotes notes;
  const auto* own = source.format == "exr-atlas" ? dynamic_cast<const LatticeTable*>(source.brdf.get()) : nullptr;
  const Lattice lattice = own != nullptr ? own->lattice() : lattice_of(coordinates, source, options.size);
  std::vector<std::vector<double>> values = lattice_values(source, lattice, same(source.brdf->channels()), options.threads, notes);
  if (fill_unknown(lattice, values) > 0) notes.lost.emplace_back("pixels beyond the horizon and unknown ones repeat their neighbour");

  ExrImage image;
  image.width = lattice.nodes_deg[0].size(), image.height = lattice.nodes_deg[2].size() * lattice.nodes_deg[3].size();
  const std::vector<std::string> names = exr_channel_names(source.brdf->channels());
  for (std::size_t c = 0; c < names.size(); ++c) {
    std::vector<double> pixels(lattice.size());
    for (std::size_t node = 0; node < lattice.size(); ++node) pixels[pixel(lattice, node)] = values[c][node];
    image.channels.emplace_back(names[c], floats(pixels, path));
  }
  std::string symmetry = lattice.bilateral ? "isotropic bilateral" : "isotropic";
  if (lattice.reciprocal) symmetry += " reciprocal";
  image.attributes = {{"atlas", "1"},
                      {"coordinates", coordinate_names[static_cast<int>(lattice.coordinates)]},
                      {"right_deg", joined(lattice.nodes_deg[0])},
                      {"down_deg", joined(lattice.nodes_deg[2])},
                      {"tiles_deg", joined(lattice.nodes_deg[3])},
                      {"symmetry", symmetry},
                      {"simulated", source.simulated ? "yes" : "no"},
                      {"unit", unit}};
  write_exr_image(image, path);
  notes.files = {path};
  notes.facts.emplace_back(
      "picture", fmt::format("{} tiles of {} x {} pixels", lattice.nodes_deg[3].size(), image.width, lattice.nodes_deg[2].size()));
  return notes;
}

std::vector<double> angles_of(const std::map<std::string, std::string>& attributes, const char* key, double last, FaultList& faults) {
  const auto at = attributes.find(key);
  std::vector<std::string_view> fields;
  if (at != attributes.end()) split(at->second, blanks, fields);
  std::vector<double> out;
  for (const std::string_view field : fields) {
    const Number number = parse_number(field);
    if (number.fault != nullptr || !(number.value >= 0 && number.value <= last) || (!out.empty() && number.value <= out.back())) {
      faults.add(fmt::format("{}#gonio.{}", faults.file(), key), excerpt(field), fmt::format("increasing angles from 0 to {}", last));
      return {};
    }
    out.push_back(number.value);
  }
  if (out.empty()) faults.add(fmt::format("{}#gonio.{}", faults.file(), key), "no angles", "at least one");
  return out;
}

}  // namespace

ExportNotes write_exr_atlas(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(LatticeCoordinates::half_difference, source, path, options);
}
ExportNotes write_exr_atlas_spherical(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(LatticeCoordinates::spherical, source, path, options);
}

ExportNotes write_exr_slice(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  require_evaluable(source, path);
  ExportNotes notes;
  const std::size_t side = 4 * tile_size(options.size);
  std::vector<double> centres;
  for (std::size_t k = 0; k < side; ++k) centres.push_back(90 * (static_cast<double>(k) + 0.5) / static_cast<double>(side));
  Lattice lattice;
  lattice.coordinates = LatticeCoordinates::half_difference;
  lattice.nodes_deg = {centres, {0}, centres, {90}};
  const std::vector<std::vector<double>> values = lattice_values(source, lattice, same(source.brdf->channels()), options.threads, notes);
  ExrImage image;
  image.width = image.height = side;
  const std::vector<std::string> names = exr_channel_names(source.brdf->channels());
  for (std::size_t c = 0; c < names.size(); ++c) {
    std::vector<double> pixels(lattice.size());
    for (std::size_t node = 0; node < lattice.size(); ++node) {
      const std::array<std::size_t, 4> at = lattice.position(node);
      pixels[(side - 1 - at[2]) * side + at[0]] = std::isnan(values[c][node]) ? 0 : values[c][node];
    }
    image.channels.emplace_back(names[c], floats(pixels, path));
  }
  image.attributes = {{"slice", "phi_d = 90 deg"},
                      {"right", "theta_h, 0 to 90 deg, even steps, pixel centres"},
                      {"up", "theta_d, 0 to 90 deg, even steps, pixel centres"},
                      {"unit", unit}};
  write_exr_image(image, path);
  notes.files = {path};
  notes.facts.emplace_back("picture", fmt::format("{0} x {0} pixels, phi_d = 90 degrees, theta_h to the right, theta_d upwards", side));
  notes.lost.emplace_back("every other phi_d: this is a picture");
  return notes;
}

bool recognises_exr_atlas(std::string_view head, std::uintmax_t) {
  return head.starts_with("\x76\x2f\x31\x01") && head.find("gonio.atlas") != std::string_view::npos;
}

Opened open_exr_atlas(const std::filesystem::path& path, const ReadOptions&) {
  const ExrImage image = read_exr_image(path);
  const std::map<std::string, std::string> attributes(image.attributes.begin(), image.attributes.end());
  const auto text = [&](const char* key) {
    const auto at = attributes.find(key);
    return at == attributes.end() ? std::string() : at->second;
  };
  FaultList faults(path.string());
  Lattice lattice;
  if (text("atlas") != "1") faults.add(path.string() + "#gonio.atlas", excerpt(text("atlas")), "1");
  if (text("coordinates") == "half_difference")
    lattice.coordinates = LatticeCoordinates::half_difference;
  else if (text("coordinates") != "spherical")
    faults.add(path.string() + "#gonio.coordinates", excerpt(text("coordinates")), "half_difference or spherical");
  lattice.bilateral = text("symmetry").find("bilateral") != std::string::npos;
  lattice.reciprocal =
      lattice.coordinates == LatticeCoordinates::half_difference && text("symmetry").find("reciprocal") != std::string::npos;
  const double last_tile = (lattice.bilateral ? 180.0 : 360.0) / (lattice.reciprocal ? 2 : 1);
  lattice.nodes_deg = {angles_of(attributes, "right_deg", 90, faults),
                       {0},
                       angles_of(attributes, "down_deg", 90, faults),
                       angles_of(attributes, "tiles_deg", last_tile, faults)};
  faults.raise();
  if (image.width != lattice.nodes_deg[0].size() || image.height != lattice.nodes_deg[2].size() * lattice.nodes_deg[3].size())
    faults.add(
        path.string(), fmt::format("{} x {} pixels", image.width, image.height),
        fmt::format("{} x {}, as the angles say", lattice.nodes_deg[0].size(), lattice.nodes_deg[2].size() * lattice.nodes_deg[3].size()));

  // Channels come in the order of their names; R, G, B and wavelengths have one of their own.
  Channels channels;
  std::vector<const std::vector<float>*> pixels;
  const auto named = [&](const std::string& name) -> const std::vector<float>* {
    for (const auto& [known, values] : image.channels)
      if (known == name) return &values;
    return nullptr;
  };
  if (named("R") && named("G") && named("B")) {
    channels = rgb_channels();
    pixels = {named("R"), named("G"), named("B")};
  } else {
    std::vector<std::pair<Channel, const std::vector<float>*>> unordered;
    for (const auto& [name, values] : image.channels) {
      Channel channel = single_channel(name.starts_with("f.") ? name.substr(2) : name == "Y" ? "value" : name).front();
      const Number number = parse_number(std::string_view(channel.name).substr(0, channel.name.find("nm")));
      if (channel.name.ends_with("nm") && number.fault == nullptr && number.value > 0) channel.wavelength_in_nm = number.value;
      unordered.emplace_back(channel, &values);
    }
    std::stable_sort(unordered.begin(), unordered.end(),
                     [](const auto& a, const auto& b) { return a.first.wavelength_in_nm < b.first.wavelength_in_nm; });
    for (const auto& [channel, values] : unordered) channels.push_back(channel), pixels.push_back(values);
  }
  std::vector<std::vector<double>> values(channels.size(), std::vector<double>(lattice.size()));
  for (std::size_t c = 0; c < channels.size() && faults.empty(); ++c)
    for (std::size_t node = 0; node < lattice.size(); ++node) {
      const double value = static_cast<double>((*pixels[c])[pixel(lattice, node)]);
      if (!std::isfinite(value))
        faults.add(fmt::format("{} pixel {}", path.string(), pixel(lattice, node)), fmt::format("{}", value), "a finite number");
      values[c][node] = value;
    }
  faults.raise();
  const std::string nodes = fmt::format("{} tiles of {} x {} angles in {} coordinates", lattice.nodes_deg[3].size(),
                                        lattice.nodes_deg[0].size(), lattice.nodes_deg[2].size(), text("coordinates"));
  Opened out =
      opened_table("exr-atlas", std::make_shared<const LatticeTable>(std::move(lattice), channels, std::move(values)), path.string());
  out.simulated = text("simulated") == "yes";
  out.info.insert(out.info.begin(), {{"holds", "f, cosine not included"}, {"unit", "1/sr"}, {"nodes", nodes}});
  return out;
}

}  // namespace gonio::tabulated
