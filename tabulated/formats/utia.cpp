// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/utia.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/lattice_values.hpp"
#include "tabulated/opened_samples.hpp"

namespace gonio::tabulated {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of the format are little-endian");

constexpr std::size_t zenith_count = 6, azimuth_count = 48, planes = 3;
constexpr std::size_t plane_size = zenith_count * azimuth_count * zenith_count * azimuth_count;
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
  return (azimuth_count * at[0] + at[1]) * zenith_count * azimuth_count + azimuth_count * at[2] + at[3];
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

ExportNotes write(bool display, const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  const Lattice grid = lattice();
  const ChannelMap map = map_to_rgb(source.brdf ? source.brdf->channels() : Channels{});
  const std::vector<std::vector<double>> values = lattice_values(source, grid, map, options.threads, notes);
  std::string bytes(utia_file_size, '\0');
  for (std::size_t c = 0; c < planes; ++c)
    for (std::size_t node = 0; node < grid.size(); ++node) {
      const double f = std::isnan(values[c][node]) ? 0 : values[c][node];
      const double number = display ? to_display(f) : f;
      std::memcpy(bytes.data() + (c * plane_size + file_index(grid.position(node))) * sizeof number, &number, sizeof number);
    }
  write_file_atomically(path, bytes);
  notes.files = {path};
  notes.facts.emplace_back("grid", "zenith angles 0 to 75 by 15 degrees, azimuths by 7.5 degrees");
  notes.facts.emplace_back("values",
                           display ? "display codes; read back with --assume values=display" : "f; read back with --assume values=f");
  if (notes.n_unknown > 0) notes.lost.emplace_back("nodes at which nothing is known are 0");
  if (display && notes.n_negative > 0) notes.lost.emplace_back("negative values are 0");
  notes.lost.emplace_back("everything beyond 75 degrees, and lobes narrower than the grid");
  return notes;
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
  const auto answer = options.assumed("values");
  if (answer && *answer != "f" && *answer != "display") throw Error(ErrorKind::usage, {"--assume values", *answer, "f or display"});
  const std::string bytes = read_file(path);
  FaultList faults(path.string());
  if (bytes.size() != utia_file_size)
    faults.add(path.string(), fmt::format("{} bytes", bytes.size()), fmt::format("{}: 3 x 288 x 288 numbers", utia_file_size));
  faults.raise();
  if (!answer)
    faults.add(path.string(), "numbers of which the file does not say what they are",
               "--assume values=f if they are f in 1/sr, =display if they are 140 times an sRGB code of f/100");
  const Lattice grid = lattice();
  std::vector<std::vector<double>> values(planes, std::vector<double>(grid.size()));
  std::size_t negative = 0;
  for (std::size_t c = 0; c < planes; ++c)
    for (std::size_t node = 0; node < grid.size(); ++node) {
      double number = 0;
      const std::size_t byte = (c * plane_size + file_index(grid.position(node))) * sizeof number;
      std::memcpy(&number, bytes.data() + byte, sizeof number);
      if (!std::isfinite(number)) faults.add(fmt::format("{} byte {}", path.string(), byte), fmt::format("{}", number), "a finite number");
      negative += number < 0 ? 1 : 0;
      values[c][node] = answer == "display" ? from_display(number) : number;
    }
  faults.raise();
  Opened out = opened_table("utia", std::make_shared<const LatticeTable>(grid, rgb_channels(), std::move(values)), path.string());
  out.info.insert(out.info.begin(), {{"holds", *answer == "f" ? "f, cosine not included" : "sRGB codes of f/100, times 140"},
                                     {"unit", "1/sr"},
                                     {"nodes", "6 x 48 x 6 x 48 directions: zenith angles 0 to 75 by 15 deg, azimuths by 7.5 deg"},
                                     {"negative numbers", std::to_string(negative)}});
  return out;
}

ExportNotes write_utia(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(false, source, path, options);
}
ExportNotes write_utia_display(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(true, source, path, options);
}

}  // namespace gonio::tabulated
