// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 by libcrypto, which uses the processor's SHA instructions where it has them.
#include "data-schemas/sha256.hpp"

#include <openssl/evp.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

#include "brdf/error.hpp"

namespace gonio {
namespace {

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new()) { require(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1); }

  void add(const void* bytes, std::size_t count) { require(EVP_DigestUpdate(context_.get(), bytes, count) == 1); }

  std::string hexadecimal() {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned length = 0;
    require(EVP_DigestFinal_ex(context_.get(), digest, &length) == 1);
    std::string text;
    for (unsigned i = 0; i < length; ++i) {
      text += "0123456789abcdef"[digest[i] >> 4];
      text += "0123456789abcdef"[digest[i] & 15];
    }
    return text;
  }

 private:
  static void require(bool fine) {
    if (!fine) throw Error(ErrorKind::internal, {"libcrypto", "a failure of SHA-256", "a digest"});
  }

  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context_;
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
