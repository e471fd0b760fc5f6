// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/mbsdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/lattice_values.hpp"
#include "tabulated/opened_samples.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of the format are little-endian");

constexpr std::string_view magic = "NVIDIA ARC MBSDF V1\n";
constexpr std::string_view any_data = "MBSDF_DATA=\n", reflection_data = "MBSDF_DATA_REFLECTION=\n",
                           transmission_data = "MBSDF_DATA_TRANSMISSION=\n";

/// Where in its cell a value lies: 1/2 in the centre, 0 at the left edge.
Lattice lattice_of(std::size_t zenith_count, std::size_t azimuth_count, double place, Side side) {
  const auto nodes = [&](std::size_t count, double range) {
    std::vector<double> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(range * (static_cast<double>(k) + place) / static_cast<double>(count));
    return out;
  };
  Lattice out;
  out.nodes_deg = {nodes(zenith_count, 90), {0}, nodes(zenith_count, 90), nodes(azimuth_count, 180)};
  out.bilateral = true;
  out.side = side;
  return out;
}

/// A block of the file: what its header says and where its numbers begin.
struct Block {
  std::uint32_t type = 0, zenith_count = 0, azimuth_count = 0;
  std::size_t first_byte = 0;

  std::size_t channel_count() const { return type == 0 ? 1 : 3; }
};

struct File {
  std::map<std::string, std::string> metadata;
  std::optional<Block> reflection, transmission;
};

/// Reads a block that begins at `at` and moves `at` behind its numbers; nothing if it is not sound.
std::optional<Block> read_block(const std::string& bytes, std::size_t& at, FaultList& faults) {
  const auto where = [&](std::size_t byte) { return fmt::format("{} byte {}", faults.file(), byte); };
  constexpr std::size_t header = 3 * sizeof(std::uint32_t);
  Block out;
  if (bytes.size() - at < header) {
    faults.add(where(at), fmt::format("{} bytes", bytes.size() - at), "12 bytes: type, zenith angles, azimuths");
    return std::nullopt;
  }
  std::memcpy(&out.type, bytes.data() + at, sizeof out.type);
  std::memcpy(&out.zenith_count, bytes.data() + at + 4, sizeof out.zenith_count);
  std::memcpy(&out.azimuth_count, bytes.data() + at + 8, sizeof out.azimuth_count);
  if (out.type > 1) faults.add(where(at), fmt::format("type {}", out.type), "0 (scalar) or 1 (RGB)");
  const std::uint64_t zenith = out.zenith_count, azimuth = out.azimuth_count;
  if (zenith == 0 || azimuth == 0 || zenith > max_lattice_nodes || azimuth > max_lattice_nodes ||
      zenith * zenith > max_lattice_nodes / azimuth) {
    faults.add(where(at + 4), fmt::format("{} zenith angles, {} azimuths", zenith, azimuth),
               fmt::format("at least one of each and at most {} cells", max_lattice_nodes));
    return std::nullopt;
  }
  if (!faults.empty()) return std::nullopt;
  at += header;
  out.first_byte = at;
  const std::uint64_t wanted = zenith * zenith * azimuth * out.channel_count() * sizeof(float);
  if (bytes.size() - at < wanted) {
    faults.add(where(at), fmt::format("{} bytes", bytes.size() - at), fmt::format("{} for the cells promised", wanted));
    return std::nullopt;
  }
  at += static_cast<std::size_t>(wanted);
  return out;
}

File read_blocks(const std::string& bytes, FaultList& faults) {
  File out;
  std::size_t at = magic.size();
  const auto line_is = [&](std::string_view line) { return std::string_view(bytes).substr(at).starts_with(line); };
  const auto is_data = [&] { return line_is(any_data) || line_is(reflection_data) || line_is(transmission_data); };
  while (at < bytes.size() && !is_data()) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::string line = bytes.substr(at, end - at);
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || equals == 0 || line.find('"', equals) == std::string::npos) {
      faults.add(fmt::format("{} byte {}", faults.file(), at), excerpt(line), "a line key=\"value\", or the beginning of the data");
      return out;
    }
    const std::size_t first = line.find('"', equals) + 1, last = line.rfind('"');
    out.metadata[line.substr(0, equals)] = first <= last ? line.substr(first, last - first) : "";
    at = std::min(end + 1, bytes.size());
  }
  if (line_is(any_data) || line_is(reflection_data)) {
    at += line_is(any_data) ? any_data.size() : reflection_data.size();
    out.reflection = read_block(bytes, at, faults);
  }
  if (faults.empty() && line_is(transmission_data)) {
    at += transmission_data.size();
    out.transmission = read_block(bytes, at, faults);
  }
  if (!faults.empty()) return out;
  if (!out.reflection && !out.transmission)
    faults.add(fmt::format("{} byte {}", faults.file(), at), "the end of the file",
               "MBSDF_DATA=, MBSDF_DATA_REFLECTION= or MBSDF_DATA_TRANSMISSION=");
  else if (at != bytes.size())
    faults.add(fmt::format("{} byte {}", faults.file(), at), fmt::format("{} bytes more", bytes.size() - at), "the end of the file");
  return out;
}

/// Where a value lies among the file's [theta_i][theta_o][azimuth].
std::size_t file_index(const Lattice& lattice, std::size_t node) {
  const std::array<std::size_t, 4> at = lattice.position(node);
  return (at[0] * lattice.nodes_deg[2].size() + at[2]) * lattice.nodes_deg[3].size() + at[3];
}

std::vector<std::vector<double>> read_values(const std::string& bytes, const Block& block, const Lattice& lattice, FaultList& faults) {
  const std::size_t channel_count = block.channel_count();
  std::vector<std::vector<double>> out(channel_count, std::vector<double>(lattice.size()));
  for (std::size_t node = 0; node < lattice.size(); ++node)
    for (std::size_t c = 0; c < channel_count; ++c) {
      float value = 0;
      const std::size_t byte = block.first_byte + (file_index(lattice, node) * channel_count + c) * sizeof value;
      std::memcpy(&value, bytes.data() + byte, sizeof value);
      if (std::isinf(value)) faults.add(fmt::format("{} byte {}", faults.file(), byte), "an infinity", "a finite number");
      out[c][node] = value;
    }
  return out;
}

/// One of two answers; the first if there is none.
bool answers_second(const ReadOptions& options, const char* key, const char* first, const char* second) {
  const auto answer = options.assumed(key);
  if (!answer || *answer == first) return false;
  if (*answer == second) return true;
  throw Error(ErrorKind::usage, {fmt::format("--assume {}", key), *answer, fmt::format("{} or {}", first, second)});
}

}  // namespace

bool recognises_mbsdf(std::string_view head, std::uintmax_t) { return head.starts_with(magic); }

Opened open_mbsdf(const std::filesystem::path& path, const ReadOptions& options) {
  const bool left = answers_second(options, "nodes", "centre", "left");
  const bool transmission = answers_second(options, "part", "reflection", "transmission");
  const std::string bytes = read_file(path);
  FaultList faults(path.string());
  if (!recognises_mbsdf(bytes, bytes.size())) faults.add(path.string() + " byte 0", excerpt(bytes), "NVIDIA ARC MBSDF V1");
  faults.raise();
  const File file = read_blocks(bytes, faults);
  faults.raise();
  if (options.assumed("part") && !(transmission ? file.transmission : file.reflection))
    throw Error(ErrorKind::input, {path.string(), "no such part", transmission ? "part=reflection" : "part=transmission"});
  const bool use_transmission = transmission || !file.reflection;
  const Block& block = use_transmission ? *file.transmission : *file.reflection;
  Lattice lattice =
      lattice_of(block.zenith_count, block.azimuth_count, left ? 0 : 0.5, use_transmission ? Side::transmission : Side::reflection);
  std::vector<std::vector<double>> values = read_values(bytes, block, lattice, faults);
  faults.raise();

  Channels channels = block.type == 0 ? single_channel("value") : rgb_channels();
  Opened out = opened_table("mbsdf", std::make_shared<const LatticeTable>(std::move(lattice), std::move(channels), std::move(values)),
                            path.string());
  out.info.insert(out.info.begin(),
                  {{"holds", "f, cosine not included"},
                   {"unit", "1/sr"},
                   {"nodes", fmt::format("{0} x {0} x {1} cells, values {2}", block.zenith_count, block.azimuth_count,
                                         left ? "at left edges" : "in centres")},
                   {"parts", fmt::format("{}{}{}", file.reflection ? "reflection" : "", file.reflection && file.transmission ? ", " : "",
                                         file.transmission ? "transmission" : "")}});
  for (const auto& [key, value] : file.metadata) out.info.emplace_back(key, value);
  return out;
}

ExportNotes write_mbsdf(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  const auto* own = source.brdf ? dynamic_cast<const LatticeTable*>(source.brdf.get()) : nullptr;
  const Side side = source.side;
  std::size_t zenith_count = options.size == GridSize::paper ? 45 : options.size == GridSize::standard ? 90 : 180;
  std::size_t azimuth_count = options.size == GridSize::fine ? 180 : 90;
  if (own != nullptr && own->lattice() == lattice_of(own->lattice().nodes_deg[0].size(), own->lattice().nodes_deg[3].size(), 0.5, side)) {
    zenith_count = own->lattice().nodes_deg[0].size();
    azimuth_count = own->lattice().nodes_deg[3].size();
  }
  const Lattice lattice = lattice_of(zenith_count, azimuth_count, 0.5, side);
  const bool scalar = source.brdf && source.brdf->channels().size() == 1;
  const ChannelMap map = scalar ? one_channel(source.brdf->channels()) : map_to_rgb(source.brdf ? source.brdf->channels() : Channels{});
  std::vector<std::vector<double>> values = lattice_values(source, lattice, map, options.threads, notes);

  std::string bytes(magic);
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  bytes += fmt::format("source=\"{}\"\nprogram=\"gonio\"\n", source.format);
  bytes += side == Side::transmission ? transmission_data : reflection_data;
  add(std::uint32_t{scalar ? 0U : 1U});
  add(static_cast<std::uint32_t>(zenith_count));
  add(static_cast<std::uint32_t>(azimuth_count));
  const std::size_t first_byte = bytes.size(), channel_count = map.to.size();
  bytes.resize(first_byte + lattice.size() * channel_count * sizeof(float));
  for (std::size_t node = 0; node < lattice.size(); ++node)
    for (std::size_t c = 0; c < channel_count; ++c) {
      const auto value = static_cast<float>(std::isnan(values[c][node]) ? 0 : values[c][node]);
      if (std::isinf(value)) throw Error(ErrorKind::input, {path.string(), fmt::format("{}", values[c][node]), "values that fit a float"});
      std::memcpy(bytes.data() + first_byte + (file_index(lattice, node) * channel_count + c) * sizeof value, &value, sizeof value);
    }
  write_file_atomically(path, bytes);
  notes.files = {path};
  notes.facts.emplace_back("grid", fmt::format("{0} theta_i x {0} theta_o x {1} azimuths, cell centres", zenith_count, azimuth_count));
  if (notes.n_unknown > 0) notes.lost.emplace_back("cells at which nothing is known are 0");
  if (notes.n_negative > 0) notes.lost.emplace_back("negative values are kept; renderers take them for 0");
  if (!source.brdf->symmetry().reciprocal) notes.lost.emplace_back("renderers show the mean of f(wi, wo) and f(wo, wi)");
  return notes;
}

}  // namespace gonio::tabulated
