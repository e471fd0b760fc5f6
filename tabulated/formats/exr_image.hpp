// SPDX-License-Identifier: BSD-3-Clause
// Plain OpenEXR pictures of float numbers.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gonio::tabulated {

struct ExrImage {
  std::size_t width = 0, height = 0;
  /// Name (`R`, `G`, `B`, `Y` for viewers, anything else for layers) and width · height numbers, row by row from the top.
  std::vector<std::pair<std::string, std::vector<float>>> channels;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< text, stored as `gonio.<name>`
};

/// Float32, ZIP compressed; whole or not at all. Error(input) if the file cannot be written.
void write_exr_image(const ExrImage& image, const std::filesystem::path& path);

/// Pictures of more pixels are not read.
constexpr std::size_t max_image_pixels = std::size_t{1} << 24;
/// The float and half channels and the text attributes `gonio.*` of the first part. Throws Error(input): not OpenEXR, damaged, compressed
/// with loss, larger than that or than the file can hold, a channel of integers.
ExrImage read_exr_image(const std::filesystem::path& path);

}  // namespace gonio::tabulated
