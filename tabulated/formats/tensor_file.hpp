// SPDX-License-Identifier: BSD-3-Clause
// The container of named arrays that RGL's material files are written in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tabulated/fault_list.hpp"

namespace gonio::tabulated {

/// The first bytes of every such file, closing NUL included.
constexpr std::string_view tensor_file_signature{"tensor_file\0", 12};

/// Element types by their number in the file.
enum class TensorType : std::uint8_t { u8 = 1, i8, u16, i16, u32, i32, u64, i64, f16, f32, f64 };
const char* name(TensorType type) noexcept;

/// One named array, C order, little-endian, where it lies in the file. The bytes need not be aligned.
struct Tensor {
  std::string name;
  TensorType type = TensorType::u8;
  std::vector<std::size_t> shape;
  std::span<const std::byte> bytes;

  std::size_t count() const noexcept;
  /// The elements of an array of float32. Only for `type == f32`.
  std::vector<float> floats() const;
  /// The bytes as text. Only for `type == u8`.
  std::string text() const;
};

/// Layout, as the readers and files of rgl.epfl.ch have it: signature, version {1, 0}, uint32 number of fields, then per field uint16
/// length and characters of the name, uint16 number of dimensions, uint8 type, uint64 offset of the data from the start of the file, uint64
/// per dimension. Faults (a file cut short, a name twice, an unknown type, an array beyond the end of the file) are added, never thrown;
/// what could be read is returned and points into `file`.
std::vector<Tensor> read_tensors(std::span<const std::byte> file, FaultList& faults);

/// The bytes of such a file, every array at a multiple of eight bytes. The bytes of each array must be those of its shape.
std::string tensor_bytes(const std::vector<Tensor>& tensors);

}  // namespace gonio::tabulated
