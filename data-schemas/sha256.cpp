// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 by Nettle, which uses the processor's SHA instructions where it has them.
#include "data-schemas/sha256.hpp"

#include <nettle/sha2.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

#include "brdf/error.hpp"

namespace gonio {
namespace {

class Digest {
 public:
  Digest() { sha256_init(&context_); }

  void add(const void* bytes, std::size_t count) { sha256_update(&context_, count, static_cast<const std::uint8_t*>(bytes)); }

  std::string hexadecimal() {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
    sha256_digest(&context_, digest.size(), digest.data());
    std::string text;
    for (const std::uint8_t byte : digest) {
      text += "0123456789abcdef"[byte >> 4];
      text += "0123456789abcdef"[byte & 15];
    }
    return text;
  }

 private:
  sha256_ctx context_;
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Digest digest;
  digest.add(bytes.data(), bytes.size());
  return digest.hexadecimal();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  constexpr std::size_t block = 256 * 1024;  // stays in the second-level cache
  const auto fail = [&] { throw Error(ErrorKind::input, {path.string(), std::generic_category().message(errno), "a readable file"}); };
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail();
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  Digest digest;
  std::vector<char> buffer(block);
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) digest.add(buffer.data(), count);
  if (std::ferror(file.get())) fail();
  return digest.hexadecimal();
}

HashedInput hash_in_background(const std::filesystem::path& path) {
  return {path.string(), std::async(std::launch::async, [path] { return sha256_of_file(path); }).share()};
}

}  // namespace gonio
