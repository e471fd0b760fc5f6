// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/exr_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>

#include "brdf/error.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/mapped_file.hpp"

namespace gonio::tabulated {
namespace {

/// Magic number and version field.
constexpr std::size_t preamble_size = 8;
constexpr std::uint32_t multi_part_flag = 1u << 12;

/// Reads names that end in a NUL and 32-bit numbers, little-endian, until the bytes run out.
class HeaderBytes {
 public:
  explicit HeaderBytes(std::span<const std::byte> bytes) : rest_(bytes), size_(bytes.size()) {}

  std::size_t offset() const noexcept { return size_ - rest_.size(); }
  std::size_t left() const noexcept { return rest_.size(); }
  void skip(std::size_t count) noexcept { rest_ = rest_.subspan(std::min(count, rest_.size())); }

  std::optional<std::string> text() {
    const auto end = std::find(rest_.begin(), rest_.end(), std::byte{0});
    if (end == rest_.end()) return std::nullopt;
    const std::string out(reinterpret_cast<const char*>(rest_.data()), static_cast<std::size_t>(end - rest_.begin()));
    skip(out.size() + 1);
    return out;
  }
  std::optional<std::int32_t> number() {
    std::int32_t value = 0;
    if (left() < sizeof value) return std::nullopt;
    std::memcpy(&value, rest_.data(), sizeof value);
    skip(sizeof value);
    return value;
  }

 private:
  std::span<const std::byte> rest_;
  std::size_t size_;
};

/// Bytes of the value of a type that always has the same number. The library reads that many whatever the attribute claims.
std::optional<std::int32_t> fixed_size(const std::string& type) {
  static const std::map<std::string, std::int32_t> sizes{{"box2i", 16},
                                                         {"box2f", 16},
                                                         {"chromaticities", 32},
                                                         {"compression", 1},
                                                         {"deepImageState", 1},
                                                         {"double", 8},
                                                         {"envmap", 1},
                                                         {"float", 4},
                                                         {"int", 4},
                                                         {"keycode", 28},
                                                         {"lineOrder", 1},
                                                         {"m33f", 36},
                                                         {"m33d", 72},
                                                         {"m44f", 64},
                                                         {"m44d", 128},
                                                         {"rational", 8},
                                                         {"tiledesc", 9},
                                                         {"timecode", 8},
                                                         {"v2i", 8},
                                                         {"v2f", 8},
                                                         {"v2d", 16},
                                                         {"v3i", 12},
                                                         {"v3f", 12},
                                                         {"v3d", 24}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? std::nullopt : std::optional(found->second);
}

/// A list of channels {name, 16 bytes} closed by an empty name, which must end where the attribute does.
bool is_channel_list(std::span<const std::byte> value) {
  constexpr std::size_t channel_size = 16;
  HeaderBytes bytes(value);
  for (auto name = bytes.text(); name; name = bytes.text()) {
    if (name->empty()) return bytes.left() == 0;
    if (bytes.left() < channel_size) return false;
    bytes.skip(channel_size);
  }
  return false;
}

/// Whether the library will read just the bytes that the attribute claims. Lists of texts and previews hold sizes of their own, and no
/// file of ours has one.
bool is_sound_value(const std::string& type, std::span<const std::byte> value) {
  if (const auto size = fixed_size(type)) return value.size() == static_cast<std::size_t>(*size);
  if (type == "chlist") return is_channel_list(value);
  return type != "stringvector" && type != "preview";
}

/// What a part asks the library to make room for before it reads a pixel.
struct Room {
  double window_pixels = 0, tile_pixels = 0, channels = 0;

  void note(const std::string& name, const std::string& type, std::span<const std::byte> value) {
    HeaderBytes bytes(value);
    const auto number = [&] { return static_cast<double>(bytes.number().value_or(0)); };
    if (name == "dataWindow" && type == "box2i") {
      const double left = number(), top = number(), right = number(), bottom = number();
      window_pixels = std::max(0.0, right - left + 1) * std::max(0.0, bottom - top + 1);
    } else if (type == "tiledesc") {
      const double width = number(), height = number();
      tile_pixels = std::fabs(width * height);
    } else if (type == "chlist") {
      constexpr double channel_size = 18;  // with a name of one letter
      channels = static_cast<double>(value.size()) / channel_size;
    }
  }
  /// With the smallest numbers a channel can have.
  double bytes() const { return 2 * channels * std::max(window_pixels, tile_pixels); }
};

}  // namespace

void require_sound_exr_header(const std::filesystem::path& path) {
  const MappedFile file(path);
  std::uint32_t version = 0;
  if (file.bytes().size() < preamble_size) return;
  std::memcpy(&version, file.bytes().data() + 4, sizeof version);
  HeaderBytes bytes(file.bytes());
  bytes.skip(preamble_size);
  // Layout (openexr.com, "OpenEXR File Layout"): per part its attributes {name, type, size, value}, closed by an empty name; in a file of
  // several parts another empty name closes the list of parts.
  Room room;
  for (bool first_of_part = true;;) {
    const std::size_t start = bytes.offset();
    const auto name = bytes.text();
    if (!name) return;
    if (name->empty()) {
      // Deflate shrinks nothing by more than 1032.
      constexpr double largest_compression = 1032;
      const double most = largest_compression * static_cast<double>(file.bytes().size());
      if (room.bytes() > most)
        throw Error(ErrorKind::input, {fmt::format("{} byte {}", path.string(), start), fmt::format("a part of {:.3g} bytes", room.bytes()),
                                       fmt::format("at most {:.3g}: a file of {} bytes cannot hold more", most, file.bytes().size())});
      room = {};
      if (first_of_part || (version & multi_part_flag) == 0) return;
      first_of_part = true;
      continue;
    }
    const auto type = bytes.text();
    const auto size = type ? bytes.number() : std::nullopt;
    if (!size) return;
    if (*size < 0 || static_cast<std::size_t>(*size) > bytes.left())
      throw Error(ErrorKind::input,
                  {fmt::format("{} byte {}", path.string(), start),
                   fmt::format("an attribute {} of {} bytes, {} bytes before the end", excerpt(*name), *size, bytes.left()),
                   "attributes that end inside the file"});
    const auto value = file.bytes().subspan(bytes.offset(), static_cast<std::size_t>(*size));
    if (!is_sound_value(*type, value))
      throw Error(ErrorKind::input, {fmt::format("{} byte {}", path.string(), start),
                                     fmt::format("an attribute {} of type {} and {} bytes", excerpt(*name), excerpt(*type), *size),
                                     "a value of its type, of a type that a table has"});
    room.note(*name, *type, value);
    bytes.skip(value.size());
    first_of_part = false;
  }
}

}  // namespace gonio::tabulated
