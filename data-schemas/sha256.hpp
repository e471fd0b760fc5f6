// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 of texts and files: how a result names its inputs.
#pragma once

#include <filesystem>
#include <future>
#include <string>
#include <string_view>

namespace gonio {

/// SHA-256 (FIPS 180-4) in lower-case hexadecimal.
std::string sha256(std::string_view bytes);
/// The same of a file's bytes; Error(input) if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// An input of a result; the hash is computed on a second thread while the work runs.
struct HashedInput {
  std::string path;                        ///< as it was given
  std::shared_future<std::string> sha256;  ///< get() waits for it, and throws what sha256_of_file throws
};
HashedInput hash_in_background(const std::filesystem::path& path);

}  // namespace gonio
