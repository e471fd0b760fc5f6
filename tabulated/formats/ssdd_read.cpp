// SPDX-License-Identifier: BSD-3-Clause
// Reading .ssdd.
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
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/ssdd.hpp"
#include "tabulated/opened_samples.hpp"

namespace gonio::tabulated {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of the format are little-endian");

constexpr std::size_t most_channels = 4096;

/// One block: its key words, each with its line, and its numbers [entry][channel].
struct Block {
  std::map<std::string, std::pair<std::string, std::size_t>> entries;
  std::size_t line = 0;
  std::vector<double> numbers;

  std::string text(const std::string& key) const {
    const auto at = entries.find(key);
    return at == entries.end() ? "" : at->second.first;
  }
  std::string data_type() const { return text("DATA_TYPE"); }
};

/// A file read from its beginning: lines, and raw bytes where a block says so.
class Reader {
 public:
  Reader(std::string_view bytes, FaultList& faults) : bytes_(bytes), faults_(faults) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::size_t line_number() const { return line_; }
  /// The next line without its end and without a comment ("#" and a blank, or a "#" that begins the line).
  std::string_view line() {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view out = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    ++line_;
    if (out.starts_with('#')) return {};
    out = out.substr(0, out.find("# "));
    const std::size_t last = out.find_last_not_of(" \t\r");
    const std::size_t first = out.find_first_not_of(" \t");
    return last == std::string_view::npos ? std::string_view{} : out.substr(first, last + 1 - first);
  }
  /// `count` floats; false, with a fault, if the file ends before.
  bool floats(std::size_t count, std::vector<double>& out) {
    if (count > (bytes_.size() - at_) / sizeof(float)) {
      faults_.add(fmt::format("{} byte {}", faults_.file(), at_), fmt::format("{} bytes", bytes_.size() - at_),
                  fmt::format("{} numbers of 4 bytes", count));
      return false;
    }
    for (std::size_t k = 0; k < count; ++k) {
      float value = 0;
      std::memcpy(&value, bytes_.data() + at_, sizeof value);
      if (!std::isfinite(value)) faults_.add(fmt::format("{} byte {}", faults_.file(), at_), fmt::format("{}", value), "a finite number");
      out.push_back(value);
      at_ += sizeof value;
    }
    return true;
  }

 private:
  std::string_view bytes_;
  FaultList& faults_;
  std::size_t at_ = 0, line_ = 0;
};

/// The numbers of a list, finite and increasing.
std::vector<double> list_of(const Block& block, const std::string& key, double low, double high, FaultList& faults) {
  const auto at = block.entries.find(key);
  if (at == block.entries.end()) return {};
  std::vector<std::string_view> fields;
  split(at->second.first, blanks, fields);
  std::vector<double> out;
  for (const std::string_view field : fields) {
    const Number number = parse_number(field);
    if (number.fault != nullptr || !(number.value >= low && number.value <= high))
      faults.add_at(at->second.second, fmt::format("{} {} in {}", number.fault ? number.fault : "the number", excerpt(field), key),
                    fmt::format("a number from {} to {}", low, high));
    else if (!out.empty() && number.value <= out.back() && key != "PARAM4_LIST")
      faults.add_at(at->second.second, fmt::format("{} after {} in {}", number.value, out.back(), key), "increasing numbers");
    out.push_back(number.value);
  }
  if (out.empty() && faults.empty()) faults.add_at(at->second.second, key + " without numbers", "at least one");
  return out;
}

Channels channels_of(const Block& block, FaultList& faults) {
  const std::string model = block.text("COLOR_MODEL");
  if (model == "monochrome") return single_channel("value");
  if (model == "rgb") return rgb_channels();
  Channels out;
  if (model == "xyz") {
    for (const char* name : {"X", "Y", "Z"}) out.push_back(single_channel(name).front());
  } else if (model == "spectrum") {
    constexpr double most_nm = 1e7;
    for (const double wavelength : list_of(block, "WAVELENGTH_LIST", 0, most_nm, faults)) {
      out.push_back(single_channel(fmt::format("{}nm", wavelength)).front());
      out.back().wavelength_in_nm = out.back().wavelength_out_nm = wavelength;
    }
    if (out.empty() && faults.empty()) faults.add_at(block.line, "a spectrum without WAVELENGTH_LIST", "the wavelengths in nm");
  } else {
    faults.add_at(block.line, fmt::format("COLOR_MODEL {}", excerpt(model)), "monochrome, rgb, xyz or spectrum");
  }
  if (out.size() > most_channels)
    faults.add_at(block.line, fmt::format("{} wavelengths", out.size()), fmt::format("at most {}", most_channels));
  return out;
}

/// The grid of a block; a block of specular reflectances has two lists only.
Lattice lattice_of(const Block& block, FaultList& faults) {
  Lattice out;
  const std::string type = block.text("PARAM_TYPE");
  const bool scatter = block.data_type() == "brdf" || block.data_type() == "btdf";
  if (type == "specular_coordinate_system")
    out.coordinates = LatticeCoordinates::specular;
  else if (type == "half_difference_coordinate_system")
    out.coordinates = LatticeCoordinates::half_difference;
  else if (type == "distorted_spherical_coordinate_system")
    out.coordinates = LatticeCoordinates::distorted;
  else if (scatter && type != "spherical_coordinate_system")
    faults.add_at(block.line, fmt::format("PARAM_TYPE {}", excerpt(type)),
                  "spherical_coordinate_system, specular_coordinate_system, half_difference_coordinate_system or "
                  "distorted_spherical_coordinate_system");

  std::vector<std::string_view> reductions;
  const std::string reduction = block.text("REDUCTION_TYPE");
  if (!reduction.empty()) split(reduction, blanks, reductions);
  for (const std::string_view word : reductions)
    if (word == "bilateral_symmetry")
      out.bilateral = true;
    else if (word == "reciprocity" && out.coordinates == LatticeCoordinates::half_difference)
      out.reciprocal = true;
    else
      faults.add_at(block.line, fmt::format("REDUCTION_TYPE {}", excerpt(word)),
                    "bilateral_symmetry, or reciprocity in half-difference coordinates");
  const bool absolute_azimuths = out.coordinates == LatticeCoordinates::spherical || out.coordinates == LatticeCoordinates::distorted;
  const double last_azimuth = (out.bilateral ? 180.0 : 360.0) / (out.reciprocal ? 2 : 1);
  const double last_third = out.coordinates == LatticeCoordinates::specular ? 180 : 90;
  out.nodes_deg[0] = list_of(block, "PARAM0_LIST", 0, 90, faults);
  out.nodes_deg[1] = list_of(block, "PARAM1_LIST", 0, 360, faults);
  if (out.nodes_deg[1].empty()) out.nodes_deg[1] = {0};
  if (out.nodes_deg[0].empty()) faults.add_at(block.line, "no PARAM0_LIST", "the first angles");
  if (scatter) {
    out.nodes_deg[2] = list_of(block, "PARAM2_LIST", 0, last_third, faults);
    out.nodes_deg[3] = list_of(block, "PARAM3_LIST", 0, last_azimuth, faults);
    for (const char* key : {"PARAM2_LIST", "PARAM3_LIST"})
      if (!block.entries.contains(key)) faults.add_at(block.line, fmt::format("no {}", key), "its angles");
    if (out.coordinates == LatticeCoordinates::specular || out.coordinates == LatticeCoordinates::distorted)
      out.offset_deg = list_of(block, "PARAM4_LIST", -90, 90, faults);
    if (!out.offset_deg.empty() && out.offset_deg.size() != out.nodes_deg[0].size())
      faults.add_at(block.line, fmt::format("{} offsets", out.offset_deg.size()),
                    fmt::format("{}, one per angle of incidence", out.nodes_deg[0].size()));
    if (out.bilateral && absolute_azimuths && out.nodes_deg[1].size() > 1)
      faults.add_at(block.line, "bilateral_symmetry of absolute azimuths", "a single azimuth of incidence, or specular coordinates");
  } else {
    out.nodes_deg[2] = out.nodes_deg[3] = {0};
  }
  // With one azimuth phi_i other than 0 the document does not say whether the last angle counts from it.
  if (absolute_azimuths && out.nodes_deg[1].size() == 1 && out.nodes_deg[1][0] != 0)
    faults.add_at(block.line, fmt::format("the one azimuth of incidence {}", out.nodes_deg[1][0]), "0, or several");
  if (block.data_type() == "btdf") out.side = Side::transmission;
  return out;
}

/// The numbers of a text block: one entry a line.
void read_text_numbers(Reader& reader, std::size_t entries, std::size_t channels, std::vector<double>& out, FaultList& faults) {
  std::vector<std::string_view> fields;
  for (std::size_t entry = 0; entry < entries;) {
    if (reader.at_end()) {
      faults.add_at(reader.line_number(), fmt::format("the end of the file after {} lines of numbers", entry),
                    fmt::format("{} lines", entries));
      return;
    }
    const std::string_view line = reader.line();
    if (line.empty()) continue;
    split(line, blanks, fields);
    if (fields.size() != channels) {
      faults.add_at(reader.line_number(), fmt::format("{} numbers", fields.size()), fmt::format("{}, one per channel", channels));
      return;
    }
    for (const std::string_view field : fields) {
      const Number number = parse_number(field);
      if (number.fault != nullptr || std::isnan(number.value))
        faults.add_at(reader.line_number(), fmt::format("{} {}", number.fault ? number.fault : "the number", excerpt(field)),
                      "a finite number");
      out.push_back(number.value);
    }
    ++entry;
  }
}

/// Key words up to DATA, then its numbers; false at the end of the file or after a fault that leaves no place to go on from.
bool read_block(Reader& reader, Block& block, FaultList& faults) {
  while (!reader.at_end()) {
    const std::string_view line = reader.line();
    if (line.empty()) continue;
    const std::size_t blank = std::min(line.find_first_of(" \t"), line.size());
    const std::string key(line.substr(0, blank));
    const std::size_t value = std::min(line.find_first_not_of(" \t", blank), line.size());
    if (block.entries.contains(key)) faults.add_at(reader.line_number(), key + " a second time", "every key once in a block");
    block.entries[key] = {std::string(line.substr(value)), reader.line_number()};
    if (key == "DATA_TYPE") block.line = reader.line_number();
    if (key != "DATA") continue;
    const std::string type = block.data_type();
    if (type != "brdf" && type != "btdf" && type != "specular_reflectance" && type != "specular_transmittance")
      faults.add_at(reader.line_number(), fmt::format("DATA of DATA_TYPE {}", excerpt(type)),
                    "brdf, btdf, specular_reflectance or specular_transmittance");
    const Lattice lattice = lattice_of(block, faults);
    const Channels channels = channels_of(block, faults);
    std::size_t entries = 1;
    for (const std::vector<double>& nodes : lattice.nodes_deg)
      entries = nodes.size() > max_lattice_nodes / std::max<std::size_t>(entries, 1) ? max_lattice_nodes + 1 : entries * nodes.size();
    if (entries > max_lattice_nodes)
      faults.add_at(reader.line_number(), "lists of too many angles", fmt::format("at most {} nodes", max_lattice_nodes));
    if (!faults.empty()) return false;
    if (block.text("DATA") == "binary") return reader.floats(entries * channels.size(), block.numbers);
    if (block.text("DATA") == "ascii")
      read_text_numbers(reader, entries, channels.size(), block.numbers, faults);
    else
      faults.add_at(reader.line_number(), fmt::format("DATA {}", excerpt(block.text("DATA"))), "ascii or binary");
    return faults.empty();
  }
  if (!block.entries.empty()) faults.add_at(reader.line_number(), "the end of the file in a block", "DATA and its numbers");
  return false;
}

std::map<std::string, Block> read_blocks(std::string_view bytes, std::string& header, FaultList& faults) {
  std::map<std::string, Block> out;
  Reader reader(bytes, faults);
  std::string_view line;
  while (!reader.at_end() && line.empty()) line = reader.line();
  if (!line.starts_with("VERSION 0."))
    faults.add_at(std::max<std::size_t>(reader.line_number(), 1), excerpt(line), "VERSION 0.1, 0.2 or 0.3");
  header = line;
  if (!faults.empty()) return out;
  for (Block block; read_block(reader, block, faults); block = {}) {
    const std::string type = block.data_type();
    if (out.contains(type)) faults.add_at(block.line, fmt::format("a second {}", type), "one block of a kind");
    out[type] = std::move(block);
  }
  if (out.empty() && faults.empty()) faults.add_at(reader.line_number(), "no block of data", "at least one");
  return out;
}

/// What a block of specular reflectances or transmittances holds, for people: the BRDF beside it does not contain it.
std::string mirror_words(const Block& block) {
  FaultList none("");
  const Lattice lattice = lattice_of(block, none);
  const std::size_t channels = channels_of(block, none).size();
  constexpr std::size_t most_words = 400;
  std::string out;
  for (std::size_t node = 0; node < lattice.size() && out.size() < most_words; ++node) {
    const std::array<std::size_t, 4> at = lattice.position(node);
    const auto first = block.numbers.begin() + static_cast<std::ptrdiff_t>(node * channels);
    out += fmt::format("{}{} at {} deg", node == 0 ? "" : "; ", fmt::join(first, first + static_cast<std::ptrdiff_t>(channels), " "),
                       lattice.nodes_deg[0][at[0]]);
    if (lattice.nodes_deg[1].size() > 1) out += fmt::format(", azimuth {} deg", lattice.nodes_deg[1][at[1]]);
  }
  return out.size() < most_words ? out : out + " ...";
}

}  // namespace

bool recognises_ssdd(std::string_view head, std::uintmax_t) {
  const auto starts_a_line = [&](std::string_view key) {
    for (std::size_t at = head.find(key); at != std::string_view::npos; at = head.find(key, at + 1))
      if (at == 0 || head[at - 1] == '\n') return true;
    return false;
  };
  return starts_a_line("VERSION 0.") && starts_a_line("DATA_TYPE ") && starts_a_line("COLOR_MODEL ");
}

Opened open_ssdd(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string bytes = read_file(path);
  FaultList faults(path.string());
  std::string header;
  const std::map<std::string, Block> blocks = read_blocks(bytes, header, faults);
  faults.raise();
  const std::string wanted = options.assumed("data_type").value_or(blocks.contains("brdf") ? "brdf" : "btdf");
  if (wanted != "brdf" && wanted != "btdf") throw Error(ErrorKind::usage, {"--assume data_type", wanted, "brdf or btdf"});
  std::string kinds;
  for (const auto& [type, block] : blocks) kinds += (kinds.empty() ? "" : ", ") + type;
  if (!blocks.contains(wanted))
    throw Error(ErrorKind::input,
                {path.string(), kinds, "a block of DATA_TYPE " + (options.assumed("data_type") ? wanted : "brdf or btdf")});

  const Block& block = blocks.at(wanted);
  Lattice lattice = lattice_of(block, faults);
  const Channels channels = channels_of(block, faults);
  std::vector<std::vector<double>> values(channels.size(), std::vector<double>(lattice.size()));
  for (std::size_t node = 0; node < lattice.size(); ++node)
    for (std::size_t c = 0; c < channels.size(); ++c) values[c][node] = block.numbers[node * channels.size() + c];
  const std::string nodes =
      fmt::format("{} x {} x {} x {} angles in a {}, numbers in {}", lattice.nodes_deg[0].size(), lattice.nodes_deg[1].size(),
                  lattice.nodes_deg[2].size(), lattice.nodes_deg[3].size(), block.text("PARAM_TYPE"), block.text("DATA"));
  Opened out = opened_table("ssdd", std::make_shared<const LatticeTable>(std::move(lattice), channels, std::move(values)), path.string());
  out.info.insert(out.info.begin(), {{"holds", "f, cosine not included"},
                                     {"unit", "1/sr"},
                                     {"nodes", nodes},
                                     {"version", header},
                                     {"blocks", kinds + "; read: " + wanted}});
  for (const char* key : {"NAME", "SOURCE_TYPE", "DEVICE", "CREATION_DATE", "MEASUREMENT_DATE"})
    if (!block.text(key).empty()) out.info.emplace_back(key, block.text(key));
  for (const auto& [type, other] : blocks)
    if (type.starts_with("specular_")) out.info.emplace_back(type, mirror_words(other));
  return out;
}

}  // namespace gonio::tabulated
