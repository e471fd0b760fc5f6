// SPDX-License-Identifier: BSD-3-Clause
// Reading `.brdf.exr`.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "tabulated/fault_list.hpp"
#include "tabulated/formats/brdf_exr.hpp"
#include "tabulated/formats/brdf_exr_channels.hpp"
#include "tabulated/formats/exr_header.hpp"
#include "tabulated/formats/metadata.hpp"
#include "tabulated/opened_samples.hpp"

namespace gonio::tabulated {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A file of parts, each looked up by name. Every fault goes into one list; what cannot be read comes back empty.
class ExrParts {
 public:
  ExrParts(const std::filesystem::path& path, FaultList& faults)
      : path_(path.string()), faults_(faults), file_(path_.c_str(), 0), file_size_(std::filesystem::file_size(path)) {}

  std::optional<int> part_named(const std::string& name) const {
    for (int k = 0; k < file_.parts(); ++k)
      if (file_.header(k).hasName() && file_.header(k).name() == name) return k;
    return std::nullopt;
  }
  const Imf::Header& header(int part) const { return file_.header(part); }
  std::string where(const std::string& part) const { return fmt::format("{}#{}", path_, part); }

  /// Width and height of a part whose pixels may be asked for. The bound keeps a damaged header from claiming the memory.
  std::optional<std::pair<std::size_t, std::size_t>> size_of(const std::string& name) {
    const auto part = part_named(name);
    if (!part) {
      faults_.add(where(name), "no such part", "parts value, uncertainty, count, incident and outgoing");
      return std::nullopt;
    }
    const Imf::Header& header = file_.header(*part);
    if (!header.hasType() || header.type() != Imf::SCANLINEIMAGE || header.compression() > Imf::ZIP_COMPRESSION) {
      faults_.add(where(name), "a part that is not of scan lines, or compressed with loss", "scan lines, ZIP, RLE or no compression");
      return std::nullopt;
    }
    const Imath::Box2i& window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1, height = std::int64_t{window.max.y} - window.min.y + 1;
    // Deflate shrinks no text by more than 1032.
    constexpr std::uintmax_t largest_compression = 1032;
    const auto limit = static_cast<std::int64_t>(std::min<std::uintmax_t>(max_table_cells, file_size_ * largest_compression));
    if (window.min != Imath::V2i(0, 0) || width < 1 || height < 1 || width > limit || height > limit / width) {
      faults_.add(where(name), fmt::format("{} x {} pixels from ({}, {})", width, height, window.min.x, window.min.y),
                  fmt::format("at most {} pixels from (0, 0)", limit));
      return std::nullopt;
    }
    return std::pair(static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  }

  /// The pixels of one channel; the part's size must have been found sound. `type` float or unsigned.
  template <class T>
  std::vector<T> pixels(const std::string& part_name, const std::string& channel, std::size_t width, std::size_t height) {
    constexpr Imf::PixelType type = std::is_same_v<T, float> ? Imf::FLOAT : Imf::UINT;
    const int part = part_named(part_name).value();
    const Imf::Channel* found = file_.header(part).channels().findChannel(channel);
    if (found == nullptr || found->type != type || found->xSampling != 1 || found->ySampling != 1) {
      faults_.add(where(part_name), fmt::format("no channel {} of {}", excerpt(channel), type == Imf::FLOAT ? "float" : "unsigned int"),
                  "that channel, one number per pixel");
      return {};
    }
    std::vector<T> out(width * height);
    Imf::FrameBuffer frame;
    frame.insert(channel, Imf::Slice(type, reinterpret_cast<char*>(out.data()), sizeof(T), sizeof(T) * width));
    Imf::InputPart input(file_, part);
    input.setFrameBuffer(frame);
    input.readPixels(0, static_cast<int>(height) - 1);
    return out;
  }

 private:
  std::string path_;
  FaultList& faults_;
  Imf::MultiPartInputFile file_;
  std::uintmax_t file_size_;
};

Metadata metadata_of(const Imf::Header& header, const std::string& where, FaultList& faults) {
  // Attributes come in the order of their names; `channel.10` must follow `channel.9`, and every channel its own number.
  std::vector<std::pair<std::string, std::string>> entries;
  const std::string prefix = exr_attribute_prefix;
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const std::string name = attribute.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
    if (name.starts_with(prefix) && text != nullptr) entries.emplace_back(name.substr(prefix.size()), text->value());
  }
  const auto channel_number = [](const std::string& key) { return key.starts_with("channel.") ? std::atoi(key.c_str() + 8) : 0; };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const auto& a, const auto& b) { return channel_number(a.first) < channel_number(b.first); });

  Metadata out;
  bool ours = false;
  for (const auto& [key, value] : entries) {
    if (key == "format") {
      ours = value == "1";
    } else if (key == "quantity") {
      if (value != "f") faults.add(where, fmt::format("quantity {}", excerpt(value)), "f");
    } else if (key == "unit" || key == "dropped_columns") {
      continue;  // for people
    } else if (!read_metadata_entry(key, value, out)) {
      faults.add(where, fmt::format("attribute {}{} = {}", prefix, key, excerpt(value)), "a known key with a value of its kind");
    }
  }
  if (!ours) faults.add(where, "an image without attribute gonio.format = 1", "a .brdf.exr");
  if (out.description.channels.empty()) faults.add(where, "no attribute gonio.channel.1", "the names of the channels");
  return out;
}

std::vector<TableDirection> read_directions(ExrParts& file, const std::string& part, std::size_t width, std::size_t height,
                                            FaultList& faults) {
  std::array<std::vector<float>, 4> columns;
  for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = file.pixels<float>(part, exr_direction_channels[k], width, height);
  std::vector<TableDirection> out;
  if (std::any_of(columns.begin(), columns.end(), [](const std::vector<float>& column) { return column.empty(); })) return out;
  for (std::size_t k = 0; k < width * height; ++k) {
    const auto sum = [&](std::size_t high) { return static_cast<double>(columns[high][k]) + static_cast<double>(columns[high + 1][k]); };
    out.push_back({sum(0), sum(2)});
    constexpr double largest_phi_deg = 1e6;  // far beyond any winding, and finite
    if (!(out.back().theta_deg >= 0 && out.back().theta_deg <= 180) || !(std::fabs(out.back().phi_deg) <= largest_phi_deg))
      faults.add(file.where(part), fmt::format("direction {}: theta {}, phi {}", k, out.back().theta_deg, out.back().phi_deg),
                 "theta from 0 to 180 degrees and a finite phi");
  }
  return out;
}

std::vector<double> doubles(const std::vector<float>& values) { return {values.begin(), values.end()}; }

/// An empty cell is all NaN, a filled one has a finite value and a positive or unknown uncertainty.
void require_sound_cells(const SampleTable& table, const ExrParts& file, FaultList& faults) {
  for (std::size_t c = 0; c < table.f.size(); ++c)
    for (std::size_t cell = 0; cell < table.cell_count(); ++cell) {
      const double f = table.f[c][cell], u = table.u[c][cell];
      const bool filled = table.count[c][cell] > 0;
      const auto at = [&](const char* part) {
        return fmt::format("{} row {}, column {}, channel {}", file.where(part), cell / table.outgoing.size(), cell % table.outgoing.size(),
                           table.description.channels[c].name);
      };
      if (std::isinf(f) || std::isnan(f) == filled)
        faults.add(at("value"), fmt::format("{} with count {}", f, table.count[c][cell]), "a finite value, or NaN with count 0");
      if (u <= 0 || std::isinf(u)) faults.add(at("uncertainty"), fmt::format("{}", u), "a positive number, or NaN for unknown");
    }
}

void read_optional_parts(ExrParts& file, SampleTable& table, FaultList& faults) {
  const std::size_t m = table.incident.size(), n = table.outgoing.size();
  const auto fits = [&](const std::string& part) {
    if (!file.part_named(part)) return false;
    const auto size = file.size_of(part);
    if (size && *size != std::pair(n, m))
      faults.add(file.where(part), fmt::format("{} x {} pixels", size->first, size->second), fmt::format("{} x {}", n, m));
    return size == std::pair(n, m);
  };
  table.deviation_deg.fill(std::vector<double>(m * n, 0));
  if (fits("deviation"))
    for (std::size_t a = 0; a < table.deviation_deg.size(); ++a) {
      const std::vector<float> values = file.pixels<float>("deviation", exr_deviation_channels[a], n, m);
      if (!values.empty()) table.deviation_deg[a] = doubles(values);
      if (!std::all_of(values.begin(), values.end(), [](float value) { return std::fabs(value) <= 180; }))
        faults.add(file.where("deviation"), "an angle that is not within 180 degrees", "small finite angles");
    }
  if (fits("coverage")) {
    const std::vector<float> values = file.pixels<float>("coverage", "Y", n, m);
    if (!values.empty()) table.coverage = doubles(values);
    for (std::size_t cell = 0; cell < table.coverage.size(); ++cell)
      if (const double value = table.coverage[cell]; table.is_empty(cell) ? !std::isnan(value) : value != 0 && value != 1 && value != 2) {
        faults.add(file.where("coverage"), fmt::format("{}", value),
                   "0, 1 or 2 for measured, interpolated, extrapolated; NaN in empty cells");
        break;
      }
  }
  table.sensitivity.assign(table.description.correlated.size(), std::vector<double>(m * n, unknown));
  if (fits("sensitivity"))
    for (std::size_t component = 0; component < table.sensitivity.size(); ++component) {
      const std::string& name = table.description.correlated[component].name;
      if (file.header(*file.part_named("sensitivity")).channels().findChannel(name) == nullptr) continue;
      const std::vector<float> values = file.pixels<float>("sensitivity", name, n, m);
      if (!values.empty()) table.sensitivity[component] = doubles(values);
      if (std::any_of(values.begin(), values.end(), [](float value) { return std::isinf(value); }))
        faults.add(file.where("sensitivity"), "an infinity", "finite numbers");
    }
}

SampleTable read_parts(const std::filesystem::path& path, FaultList& faults) {
  ExrParts file(path, faults);
  if (!file.part_named("value") && !file.part_named("incident") && !file.part_named("outgoing"))
    throw Error(ErrorKind::input, {path.string(), "an OpenEXR picture without the parts of a table",
                                   "parts value, uncertainty, count, incident and outgoing, or an atlas or a table of another kind"});
  const auto value = file.size_of("value"), uncertainty = file.size_of("uncertainty"), count = file.size_of("count"),
             incident = file.size_of("incident"), outgoing = file.size_of("outgoing");
  faults.raise();
  const auto [n, m] = *value;
  const auto require_size = [&](const char* part, const auto& size, std::size_t width, std::size_t height) {
    if (size->first != width || size->second != height)
      faults.add(file.where(part), fmt::format("{} x {} pixels", size->first, size->second), fmt::format("{} x {}", width, height));
  };
  require_size("uncertainty", uncertainty, n, m);
  require_size("count", count, n, m);
  require_size("incident", incident, 1, m);
  require_size("outgoing", outgoing, n, 1);
  SampleTable out;
  out.description = metadata_of(file.header(*file.part_named("value")), file.where("value"), faults).description;
  faults.raise();

  out.incident = read_directions(file, "incident", 1, m, faults);
  out.outgoing = read_directions(file, "outgoing", n, 1, faults);
  for (const std::string& name : exr_channel_names(out.description.channels)) {
    out.f.push_back(doubles(file.pixels<float>("value", name, n, m)));
    out.u.push_back(doubles(file.pixels<float>("uncertainty", name, n, m)));
    out.count.push_back(file.pixels<std::uint32_t>("count", name, n, m));
  }
  faults.raise();
  require_sound_cells(out, file, faults);
  read_optional_parts(file, out, faults);
  faults.raise();
  return out;
}

}  // namespace

SampleTable read_brdf_exr(const std::filesystem::path& path) {
  // Before the library allocates by what a header claims.
  constexpr auto limit = static_cast<int>(max_table_directions);
  Imf::Header::setMaxImageSize(limit, limit);
  require_sound_exr_header(path);
  FaultList faults(path.string());
  try {
    return read_parts(path, faults);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ErrorKind::input, {path.string(), error.what(), "a whole OpenEXR file"});
  }
}

bool recognises_brdf_exr(std::string_view head, std::uintmax_t) { return head.starts_with("\x76\x2f\x31\x01"); }

Opened open_brdf_exr(const std::filesystem::path& path, const ReadOptions&) {
  const SampleTable table = read_brdf_exr(path);
  const auto dataset = std::make_shared<const Dataset>(samples_of(table));
  if (dataset->size() == 0) throw Error(ErrorKind::input, {path.string(), "a table with every cell empty", "at least one value"});
  Opened out = opened_samples("brdf-exr", dataset);
  out.info.insert(out.info.begin(),
                  {{"holds", "f, cosine not included"},
                   {"unit", "1/sr"},
                   {"nodes", "at the samples, one for each pair of directions"},
                   {"table", fmt::format("{} incident x {} outgoing directions, {} of {} cells empty", table.incident.size(),
                                         table.outgoing.size(), table.cell_count() - dataset->size(), table.cell_count())}});
  return out;
}

}  // namespace gonio::tabulated
