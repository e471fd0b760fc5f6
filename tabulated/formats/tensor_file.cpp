// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/tensor_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

namespace gonio::tabulated {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of the file are used as they lie");

constexpr std::array<std::size_t, 12> element_size{0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
constexpr std::array<const char*, 12> type_names{"", "u8", "i8", "u16", "i16", "u32", "i32", "u64", "i64", "f16", "f32", "f64"};
/// More dimensions than any field of the format has, few enough to print.
constexpr std::uint16_t most_dimensions = 16;

/// Takes numbers off the front of a file; nothing once it has run out.
class Cursor {
 public:
  explicit Cursor(std::span<const std::byte> rest) : rest_(rest) {}

  template <class T>
  std::optional<T> take() {
    if (rest_.size() < sizeof(T)) return std::nullopt;
    T value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_ = rest_.subspan(sizeof value);
    return value;
  }
  std::optional<std::string> take_text(std::size_t size) {
    if (rest_.size() < size) return std::nullopt;
    std::string out(reinterpret_cast<const char*>(rest_.data()), size);
    rest_ = rest_.subspan(size);
    return out;
  }

 private:
  std::span<const std::byte> rest_;
};

/// The number of bytes of an array, or nothing if it is more than `most`.
std::optional<std::size_t> size_of(const std::vector<std::uint64_t>& shape, std::size_t element, std::size_t most) {
  if (std::find(shape.begin(), shape.end(), 0u) != shape.end()) return 0;
  std::size_t size = element;
  for (const std::uint64_t extent : shape) {
    if (extent > most / size) return std::nullopt;
    size *= static_cast<std::size_t>(extent);
  }
  return size;
}

/// One field; false where the table of fields ends before it does.
bool read_field(Cursor& cursor, std::span<const std::byte> file, std::vector<Tensor>& out, FaultList& faults) {
  const auto name_size = cursor.take<std::uint16_t>();
  const auto field_name = name_size ? cursor.take_text(*name_size) : std::nullopt;
  const auto dimensions = field_name ? cursor.take<std::uint16_t>() : std::nullopt;
  const auto type = dimensions ? cursor.take<std::uint8_t>() : std::nullopt;
  const auto offset = type ? cursor.take<std::uint64_t>() : std::nullopt;
  if (!offset) return false;
  const std::string where = fmt::format("{} field {}", faults.file(), excerpt(*field_name));
  if (*dimensions > most_dimensions) {
    faults.add(where, fmt::format("{} dimensions", *dimensions), fmt::format("at most {}", most_dimensions));
    return false;  // where the next field starts is anybody's guess
  }
  std::vector<std::uint64_t> shape;
  for (std::uint16_t k = 0; k < *dimensions; ++k) {
    const auto extent = cursor.take<std::uint64_t>();
    if (!extent) return false;
    shape.push_back(*extent);
  }
  if (*type == 0 || *type >= element_size.size()) {
    faults.add(where, fmt::format("element type {}", *type), "a type from 1 (u8) to 11 (f64)");
    return true;
  }
  const std::size_t room = *offset <= file.size() ? file.size() - static_cast<std::size_t>(*offset) : 0;
  const auto size = size_of(shape, element_size[*type], room);
  if (!size || *offset > file.size()) {
    faults.add(where, fmt::format("{} of {} from byte {} of {}", fmt::join(shape, " x "), type_names[*type], *offset, file.size()),
               "an array that ends within the file");
    return true;
  }
  if (std::any_of(out.begin(), out.end(), [&](const Tensor& tensor) { return tensor.name == *field_name; })) {
    faults.add(where, "a second field of that name", "each name once");
    return true;
  }
  out.push_back(
      {*field_name, static_cast<TensorType>(*type), {shape.begin(), shape.end()}, file.subspan(static_cast<std::size_t>(*offset), *size)});
  return true;
}

}  // namespace

const char* name(TensorType type) noexcept { return type_names[static_cast<std::size_t>(type)]; }

std::size_t Tensor::count() const noexcept { return bytes.size() / element_size[static_cast<std::size_t>(type)]; }

std::vector<float> Tensor::floats() const {
  std::vector<float> out(count());
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

std::string Tensor::text() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::vector<Tensor> read_tensors(std::span<const std::byte> file, FaultList& faults) {
  Cursor cursor(file);
  const auto signature = cursor.take_text(tensor_file_signature.size());
  if (!signature || *signature != tensor_file_signature) {
    faults.add(faults.file(), "other first bytes", "'tensor_file' and a NUL");
    return {};
  }
  const auto major = cursor.take<std::uint8_t>(), minor = cursor.take<std::uint8_t>();
  if (major && minor && (*major != 1 || *minor != 0))
    faults.add(faults.file(), fmt::format("version {}.{}", *major, *minor), "version 1.0");
  const auto count = cursor.take<std::uint32_t>();
  if (!count) {
    faults.add(faults.file(), fmt::format("{} bytes", file.size()), "a version and a number of fields");
    return {};
  }
  std::vector<Tensor> out;
  for (std::uint32_t k = 0; k < *count; ++k)
    if (!read_field(cursor, file, out, faults)) {
      faults.add(faults.file(), fmt::format("a table of fields that breaks off after {}", k), fmt::format("{} fields", *count));
      break;
    }
  return out;
}

}  // namespace gonio::tabulated
