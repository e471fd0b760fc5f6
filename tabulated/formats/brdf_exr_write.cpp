// SPDX-License-Identifier: BSD-3-Clause
// Writing `.brdf.exr`.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "data-schemas/write_file.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/brdf_exr.hpp"
#include "tabulated/formats/brdf_exr_channels.hpp"
#include "tabulated/formats/metadata.hpp"

namespace gonio::tabulated {
namespace {

/// The file in memory, so that it can reach the disk whole or not at all.
class MemoryStream final : public Imf::OStream {
 public:
  MemoryStream() : OStream("memory") {}
  void write(const char bytes[], int count) override {
    const std::size_t end = position_ + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::copy_n(bytes, count, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ = end;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

/// One part: its name, its size and its channels as floats or counts.
struct Part {
  std::string name;
  std::size_t width, height;
  std::vector<std::pair<std::string, std::vector<float>>> channels;
  std::vector<std::pair<std::string, const std::vector<std::uint32_t>*>> counts;
};

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

std::vector<float> floats(const std::vector<double>& values, const char* what, FaultList& faults) {
  std::vector<float> out;
  out.reserve(values.size());
  for (const double value : values) {
    out.push_back(std::isnan(value) ? unknown : static_cast<float>(value));
    if (std::isinf(out.back())) faults.add(what, fmt::format("{}", value), "a number that fits a float");
  }
  return out;
}

Part direction_part(std::string name, const std::vector<TableDirection>& directions, bool as_column) {
  Part out{std::move(name), as_column ? 1 : directions.size(), as_column ? directions.size() : 1, {}, {}};
  for (const char* channel : exr_direction_channels) out.channels.emplace_back(channel, std::vector<float>());
  for (const TableDirection& direction : directions)
    for (std::size_t k = 0; const double angle : {direction.theta_deg, direction.phi_deg}) {
      const auto high = static_cast<float>(angle);
      out.channels[k++].second.push_back(high);
      out.channels[k++].second.push_back(static_cast<float>(angle - static_cast<double>(high)));
    }
  return out;
}

std::vector<Part> parts_of(const SampleTable& table, FaultList& faults) {
  const std::size_t m = table.incident.size(), n = table.outgoing.size();
  const Channels& channels = table.description.channels;
  const std::vector<std::string> names = exr_channel_names(channels);
  Part value{"value", n, m, {}, {}}, uncertainty{"uncertainty", n, m, {}, {}}, count{"count", n, m, {}, {}};
  for (std::size_t c = 0; c < names.size(); ++c) {
    value.channels.emplace_back(names[c], floats(table.f[c], "a value", faults));
    uncertainty.channels.emplace_back(names[c], floats(table.u[c], "an uncertainty", faults));
    // A positive uncertainty must not become 0, which would say that there is none.
    for (float& u : uncertainty.channels.back().second) u = u == 0 ? std::numeric_limits<float>::denorm_min() : u;
    count.counts.emplace_back(names[c], &table.count[c]);
  }
  if (names[0].starts_with("f.")) value.channels.emplace_back("Y", value.channels[exr_shown_channel(channels)].second);
  std::vector<Part> out{std::move(value), std::move(uncertainty), std::move(count), direction_part("incident", table.incident, true),
                        direction_part("outgoing", table.outgoing, false)};

  const auto& deviations = table.deviation_deg;
  const bool deviates = std::any_of(deviations.begin(), deviations.end(), [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double x) { return x != 0; });
  });
  if (deviates) {
    out.push_back({"deviation", n, m, {}, {}});
    for (std::size_t a = 0; a < deviations.size(); ++a)
      out.back().channels.emplace_back(exr_deviation_channels[a], floats(deviations[a], "an angle", faults));
  }
  if (!table.coverage.empty()) {
    out.push_back({"coverage", n, m, {}, {}});
    out.back().channels.emplace_back("Y", floats(table.coverage, "a coverage", faults));
  }
  Part sensitivity{"sensitivity", n, m, {}, {}};
  for (std::size_t component = 0; component < table.sensitivity.size(); ++component) {
    const std::vector<double>& values = table.sensitivity[component];
    if (std::any_of(values.begin(), values.end(), [](double x) { return !std::isnan(x); }))
      sensitivity.channels.emplace_back(table.description.correlated[component].name, floats(values, "a sensitivity", faults));
  }
  if (!sensitivity.channels.empty()) out.push_back(std::move(sensitivity));
  return out;
}

void require_writable_names(const std::vector<Part>& parts, FaultList& faults) {
  constexpr std::size_t longest = 255;  // of an OpenEXR name
  for (const Part& part : parts) {
    std::set<std::string> seen;
    for (const auto& [name, values] : part.channels)
      if (name.empty() || name.size() > longest || name.find('\0') != std::string::npos || !seen.insert(name).second)
        faults.add(fmt::format("part {}", part.name), fmt::format("a channel named {}", excerpt(name)),
                   "a name of its own, 1 to 255 bytes");
  }
}

Imf::Header header_of(const Part& part, int display_width, int display_height) {
  const Imath::Box2i display({0, 0}, {display_width - 1, display_height - 1});
  const Imath::Box2i data({0, 0}, {static_cast<int>(part.width) - 1, static_cast<int>(part.height) - 1});
  Imf::Header out(display, data, 1, {0, 0}, 1, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  out.setName(part.name);
  out.setType(Imf::SCANLINEIMAGE);
  for (const auto& [name, values] : part.channels) out.channels().insert(name, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, values] : part.counts) out.channels().insert(name, Imf::Channel(Imf::UINT));
  return out;
}

Imf::FrameBuffer frame_of(const Part& part) {
  Imf::FrameBuffer out;
  const auto insert = [&](const std::string& name, Imf::PixelType type, const void* data) {
    constexpr std::size_t element = 4;
    // The library takes a pointer to non-const for reading and writing alike; here it only reads.
    out.insert(name, Imf::Slice(type, const_cast<char*>(static_cast<const char*>(data)), element, element * part.width));
  };
  for (const auto& [name, values] : part.channels) insert(name, Imf::FLOAT, values.data());
  for (const auto& [name, values] : part.counts) insert(name, Imf::UINT, values->data());
  return out;
}

}  // namespace

void write_brdf_exr(const SampleTable& table, const std::filesystem::path& path) {
  FaultList faults(path.string());
  if (table.cell_count() == 0 || table.description.channels.empty())
    faults.add(path.string(), "a table without cells or channels", "at least one sample");
  faults.raise();
  const std::vector<Part> parts = parts_of(table, faults);
  require_writable_names(parts, faults);
  faults.raise();

  std::vector<Imf::Header> headers;
  for (const Part& part : parts)
    headers.push_back(header_of(part, static_cast<int>(table.outgoing.size()), static_cast<int>(table.incident.size())));
  const auto attribute = [&](const std::string& key, const std::string& value) {
    headers.front().insert(exr_attribute_prefix + key, Imf::StringAttribute(value));
  };
  attribute("format", "1");
  attribute("quantity", "f");
  attribute("unit", "1/sr, cosine not included");
  for (const auto& [key, value] : metadata_entries(table.description)) attribute(key, value);
  if (!table.dropped_columns.empty()) attribute("dropped_columns", fmt::format("{}", fmt::join(table.dropped_columns, ", ")));

  MemoryStream stream;
  try {
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t k = 0; k < parts.size(); ++k) {
      Imf::OutputPart part(file, static_cast<int>(k));
      part.setFrameBuffer(frame_of(parts[k]));
      part.writePixels(static_cast<int>(parts[k].height));
    }
  } catch (const std::exception& error) {
    throw Error(ErrorKind::input, {path.string(), error.what(), "a table that OpenEXR can hold"});
  }
  write_file_atomically(path, stream.bytes());
}

}  // namespace gonio::tabulated
