// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/utia.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/exr_image.hpp"
#include "tabulated/lattice_values.hpp"
#include "tabulated/opened_samples.hpp"

namespace gonio::tabulated {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of the format are little-endian");

constexpr std::size_t zenith_count = 6, azimuth_count = 48, planes = 3;
constexpr std::size_t side = zenith_count * azimuth_count, plane_size = side * side;
static_assert(utia_file_size == planes * plane_size * sizeof(double));

Lattice lattice() {
  Lattice out;
  for (const std::size_t axis : {0u, 2u})
    for (std::size_t k = 0; k < zenith_count; ++k) out.nodes_deg[axis].push_back(15.0 * static_cast<double>(k));
  for (const std::size_t axis : {1u, 3u})
    for (std::size_t k = 0; k < azimuth_count; ++k) out.nodes_deg[axis].push_back(7.5 * static_cast<double>(k));
  return out;
}

std::size_t file_index(const std::array<std::size_t, 4>& at) {
  return (azimuth_count * at[0] + at[1]) * side + azimuth_count * at[2] + at[3];
}

/// The code of sRGB (IEC 61966-2-1), with the threshold that readers of this format use.
constexpr double code_threshold = 0.0375, code_scale = 140, f_scale = 100;

double from_display(double code) {
  const double value = std::max(0.0, code) / code_scale;
  return f_scale * (value > code_threshold ? std::pow((value + 0.055) / 1.055, 2.4) : value / 12.92);
}

double to_display(double f) {
  const double value = std::max(0.0, f) / f_scale;
  const double linear = value * 12.92;
  return code_scale * (linear > code_threshold ? 1.055 * std::pow(value, 1 / 2.4) - 0.055 : linear);
}

/// The numbers of a file, [channel][file_index]; unknown nodes as 0.
std::vector<std::vector<double>> numbers_of(bool display, const Opened& source, const WriteOptions& options, ExportNotes& notes) {
  const Lattice grid = lattice();
  const ChannelMap map = map_to_rgb(source.brdf ? source.brdf->channels() : Channels{});
  const std::vector<std::vector<double>> values = lattice_values(source, grid, map, options.threads, notes);
  std::vector<std::vector<double>> out(planes, std::vector<double>(plane_size));
  for (std::size_t c = 0; c < planes; ++c)
    for (std::size_t node = 0; node < grid.size(); ++node) {
      const double f = std::isnan(values[c][node]) ? 0 : values[c][node];
      out[c][file_index(grid.position(node))] = display ? to_display(f) : f;
    }
  notes.facts.emplace_back("grid", "zenith angles 0 to 75 by 15 degrees, azimuths by 7.5 degrees");
  notes.assume["values"] = display ? "display" : "f";
  if (notes.n_unknown > 0) notes.lost.emplace_back("nodes at which nothing is known are 0");
  if (display && notes.n_negative > 0) notes.lost.emplace_back("negative values are 0");
  notes.lost.emplace_back("everything beyond 75 degrees, and lobes narrower than the grid");
  return out;
}

ExportNotes write_bin(bool display, const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  std::string bytes;
  for (const std::vector<double>& plane : numbers_of(display, source, options, notes))
    bytes.append(reinterpret_cast<const char*>(plane.data()), plane.size() * sizeof(double));
  write_file_atomically(path, bytes);
  notes.files = {path};
  return notes;
}

/// Whether the numbers are codes for display, as the user says.
bool are_display_codes(const std::string& file, const ReadOptions& options) {
  const auto answer = options.assumed("values");
  if (!answer)
    throw Error(ErrorKind::input, {file, "numbers of which the file does not say what they are",
                                   "--assume values=f if they are f in 1/sr, =display if they are 140 times an sRGB code of f/100"});
  if (*answer != "f" && *answer != "display") throw Error(ErrorKind::usage, {"--assume values", *answer, "f or display"});
  return *answer == "display";
}

/// The table of `number(channel, file_index)`, finite numbers.
template <class Number>
Opened opened_utia(const char* format, const std::filesystem::path& path, bool display, Number number) {
  const Lattice grid = lattice();
  std::vector<std::vector<double>> values(planes, std::vector<double>(grid.size()));
  std::size_t negative = 0;
  for (std::size_t c = 0; c < planes; ++c)
    for (std::size_t node = 0; node < grid.size(); ++node) {
      const double stored = number(c, file_index(grid.position(node)));
      negative += stored < 0 ? 1 : 0;
      values[c][node] = display ? from_display(stored) : stored;
    }
  Opened out = opened_table(format, std::make_shared<const LatticeTable>(grid, rgb_channels(), std::move(values)), path.string());
  out.info.insert(out.info.begin(),
                  {{"holds", display ? "sRGB codes of f/100, times 140 (as assumed)" : "f, cosine not included (as assumed)"},
                   {"unit", "1/sr"},
                   {"nodes", "6 x 48 x 6 x 48 directions: zenith angles 0 to 75 by 15 deg, azimuths by 7.5 deg"},
                   {"negative numbers", std::to_string(negative)}});
  return out;
}

}  // namespace

bool recognises_utia(std::string_view head, std::uintmax_t size) {
  if (size != utia_file_size) return false;
  constexpr double least = 1e-9, most = 1e6;
  for (std::size_t byte = 0; byte + sizeof(double) <= head.size(); byte += sizeof(double)) {
    double value = 0;
    std::memcpy(&value, head.data() + byte, sizeof value);
    if (value != 0 && !(std::fabs(value) > least && std::fabs(value) < most)) return false;
  }
  return true;
}

Opened open_utia(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string bytes = read_file(path);
  if (bytes.size() != utia_file_size)
    throw Error(ErrorKind::input,
                {path.string(), fmt::format("{} bytes", bytes.size()), fmt::format("{}: 3 x {} x {} numbers", utia_file_size, side, side)});
  const bool display = are_display_codes(path.string(), options);
  const auto number = [&](std::size_t c, std::size_t index) {
    double out = 0;
    std::memcpy(&out, bytes.data() + (c * plane_size + index) * sizeof out, sizeof out);
    return out;
  };
  FaultList faults(path.string());
  for (std::size_t k = 0; k < planes * plane_size; ++k)
    if (const double value = number(0, k); !std::isfinite(display ? from_display(value) : value))
      faults.add(fmt::format("{} byte {}", path.string(), k * sizeof value), fmt::format("{}", value), "a finite number of a BRDF");
  faults.raise();
  return opened_utia("utia", path, display, number);
}

bool recognises_utia_exr(std::string_view head, std::uintmax_t) {
  if (!head.starts_with("\x76\x2f\x31\x01") || head.find("gonio.") != std::string_view::npos) return false;
  constexpr std::string_view window("dataWindow\0box2i\0\x10\0\0\0", 21), channels("channels\0chlist\0", 16);
  const std::size_t at = head.find(window), list = head.find(channels);
  if (at == std::string_view::npos || list == std::string_view::npos) return false;
  std::int32_t corners[4] = {};
  if (head.size() - at < window.size() + sizeof corners) return false;
  std::memcpy(corners, head.data() + at + window.size(), sizeof corners);
  // Names of channels, each before 16 bytes of its properties, in the order of the alphabet; before them the size of the list.
  constexpr std::size_t entry = 2 + 16;
  const std::string_view names = head.substr(list + channels.size() + sizeof(std::int32_t));
  return corners[0] == 0 && corners[1] == 0 && corners[2] == side - 1 && corners[3] == side - 1 && names.size() > 2 * entry &&
         names[0] == 'B' && names[entry] == 'G' && names[2 * entry] == 'R';
}

Opened open_utia_exr(const std::filesystem::path& path, const ReadOptions& options) {
  const ExrImage image = read_exr_image(path);
  FaultList faults(path.string());
  if (image.width != side || image.height != side)
    faults.add(path.string(), fmt::format("{} x {} pixels", image.width, image.height), fmt::format("{} x {}", side, side));
  std::array<const std::vector<float>*, planes> pixels{};
  constexpr const char* names[planes] = {"R", "G", "B"};
  for (std::size_t c = 0; c < planes; ++c) {
    for (const auto& [name, values] : image.channels)
      if (name == names[c]) pixels[c] = &values;
    if (pixels[c] == nullptr) faults.add(path.string(), fmt::format("no channel {}", names[c]), "channels R, G, B");
  }
  faults.raise();
  const bool display = are_display_codes(path.string(), options);
  for (std::size_t c = 0; c < planes; ++c)
    for (std::size_t k = 0; k < plane_size; ++k)
      if (const float value = (*pixels[c])[k]; !std::isfinite(value))
        faults.add(fmt::format("{} pixel ({}, {}) of {}", path.string(), k % side, k / side, names[c]), fmt::format("{}", value),
                   "a finite number");
  faults.raise();
  return opened_utia("utia-exr", path, display, [&](std::size_t c, std::size_t index) { return static_cast<double>((*pixels[c])[index]); });
}

ExportNotes write_utia(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write_bin(false, source, path, options);
}
ExportNotes write_utia_display(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write_bin(true, source, path, options);
}

ExportNotes write_utia_exr(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  const std::vector<std::vector<double>> numbers = numbers_of(false, source, options, notes);
  ExrImage image;
  image.width = image.height = side;
  constexpr const char* names[planes] = {"R", "G", "B"};
  for (std::size_t c = 0; c < planes; ++c) {
    image.channels.emplace_back(names[c], std::vector<float>(numbers[c].begin(), numbers[c].end()));
    for (const float value : image.channels.back().second)
      if (std::isinf(value)) throw Error(ErrorKind::input, {path.string(), "a value beyond the range of float", "values that fit a float"});
  }
  write_exr_image(image, path);
  notes.files = {path};
  return notes;
}

}  // namespace gonio::tabulated
