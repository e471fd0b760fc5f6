// SPDX-License-Identifier: BSD-3-Clause
// Writes files of named arrays for the tests of their readers.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio::test {

struct TensorField {
  std::string name;
  std::vector<std::uint64_t> shape;
  std::uint8_t type = 10;
  std::string bytes;
};

inline TensorField floats(std::string name, std::vector<std::uint64_t> shape, const std::vector<float>& values) {
  TensorField out{std::move(name), std::move(shape), 10, std::string(values.size() * sizeof(float), '\0')};
  std::memcpy(out.bytes.data(), values.data(), out.bytes.size());
  return out;
}

inline TensorField bytes(std::string name, std::string text) { return {std::move(name), {text.size()}, 1, text}; }

/// The container: header, table of fields, data one after the other.
inline std::string tensor_file(const std::vector<TensorField>& fields) {
  const auto append = [](std::string& out, auto value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  std::uint64_t offset = 18;
  for (const TensorField& field : fields) offset += 2 + field.name.size() + 2 + 1 + 8 + 8 * field.shape.size();
  std::string out("tensor_file\0\1\0", 14), data;
  append(out, static_cast<std::uint32_t>(fields.size()));
  for (const TensorField& field : fields) {
    append(out, static_cast<std::uint16_t>(field.name.size()));
    out += field.name;
    append(out, static_cast<std::uint16_t>(field.shape.size()));
    append(out, field.type);
    append(out, offset + data.size());
    for (const std::uint64_t extent : field.shape) append(out, extent);
    data += field.bytes;
  }
  return out + data;
}

/// A material whose values are known: `value(slice, channel, x, y)` on 3 x 3 nodes, half vectors of constant density unless `visible`
/// gives another at (x, y) of the square, ndf 2 and sigma 0.5 everywhere, so that f cos theta_o = S.
struct RglMaterial {
  std::vector<float> phi_i{0}, theta_i{0, 0.5f, 1.5707963f};
  std::vector<float> wavelengths{};  ///< empty: RGB
  std::function<double(std::size_t, std::size_t, double, double)> value = [](std::size_t, std::size_t, double, double) { return 1.0; };
  std::function<double(double, double)> visible = [](double, double) { return 1.0; };

  std::vector<TensorField> fields() const {
    constexpr std::size_t nodes = 3;
    const std::size_t slices = phi_i.size() * theta_i.size(), channels = wavelengths.empty() ? 3 : wavelengths.size();
    std::vector<float> density, values;
    for (std::size_t slice = 0; slice < slices; ++slice) {
      for (std::size_t k = 0; k < nodes * nodes; ++k)
        density.push_back(static_cast<float>(visible(static_cast<double>(k % nodes) / 2, static_cast<double>(k / nodes) / 2)));
      for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t k = 0; k < nodes * nodes; ++k)
          values.push_back(static_cast<float>(value(slice, c, static_cast<double>(k % nodes) / 2, static_cast<double>(k / nodes) / 2)));
    }
    const std::uint64_t p = phi_i.size(), t = theta_i.size();
    std::vector<TensorField> out{bytes("description", "a test"),
                                 floats("phi_i", {p}, phi_i),
                                 floats("theta_i", {t}, theta_i),
                                 floats("sigma", {2, 2}, std::vector<float>(4, 0.5f)),
                                 floats("ndf", {2, 2}, std::vector<float>(4, 2.0f)),
                                 floats("vndf", {p, t, nodes, nodes}, density),
                                 floats("luminance", {p, t, nodes, nodes}, std::vector<float>(slices * nodes * nodes, 1.0f)),
                                 bytes("jacobian", "\1")};
    if (wavelengths.empty()) {
      out.push_back(floats("rgb", {p, t, 3, nodes, nodes}, values));
    } else {
      out.push_back(floats("wavelengths", {channels}, wavelengths));
      out.push_back(floats("spectra", {p, t, channels, nodes, nodes}, values));
    }
    return out;
  }
};

}  // namespace gonio::test
