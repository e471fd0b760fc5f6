// SPDX-License-Identifier: BSD-3-Clause
// Writing the container of named arrays.
#include <fmt/format.h>

#include <limits>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/formats/tensor_file.hpp"

namespace gonio::tabulated {
namespace {

constexpr std::size_t alignment = 8;

template <class T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::size_t aligned(std::size_t offset) { return (offset + alignment - 1) / alignment * alignment; }

}  // namespace

std::string tensor_bytes(const std::vector<Tensor>& tensors) {
  std::size_t end = tensor_file_signature.size() + 2 + sizeof(std::uint32_t);
  for (const Tensor& tensor : tensors) {
    if (tensor.name.size() > std::numeric_limits<std::uint16_t>::max())
      throw Error(ErrorKind::internal, {"an array to be written", "a name of more than 65535 bytes", "a short name"});
    end += sizeof(std::uint16_t) + tensor.name.size() + sizeof(std::uint16_t) + sizeof(std::uint8_t) +
           (1 + tensor.shape.size()) * sizeof(std::uint64_t);
  }

  std::string out(tensor_file_signature);
  out.append({1, 0});
  append(out, static_cast<std::uint32_t>(tensors.size()));
  for (const Tensor& tensor : tensors) {
    const std::size_t offset = aligned(end);
    append(out, static_cast<std::uint16_t>(tensor.name.size()));
    out += tensor.name;
    append(out, static_cast<std::uint16_t>(tensor.shape.size()));
    append(out, static_cast<std::uint8_t>(tensor.type));
    append(out, static_cast<std::uint64_t>(offset));
    for (const std::size_t extent : tensor.shape) append(out, static_cast<std::uint64_t>(extent));
    end = offset + tensor.bytes.size();
  }
  out.reserve(end);
  for (const Tensor& tensor : tensors) {
    out.resize(aligned(out.size()));
    out.append(reinterpret_cast<const char*>(tensor.bytes.data()), tensor.bytes.size());
  }
  return out;
}

}  // namespace gonio::tabulated
