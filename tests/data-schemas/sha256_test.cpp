// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 against the published vectors.
#include "data-schemas/sha256.hpp"

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using gonio::sha256;

namespace {
// NIST, "Examples with intermediate values: SHA-256", and the vectors of FIPS 180-2 appendix B.
const char* const of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
const char* const of_two_blocks = "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1";
const char* const of_million_a = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
const char* const of_nothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
}  // namespace

TEST_CASE("SHA-256 gives NIST's values", "[sha256]") {
  CHECK(sha256("abc") == of_abc);
  CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") == of_two_blocks);
  CHECK(sha256(std::string(1'000'000, 'a')) == of_million_a);
  CHECK(sha256("") == of_nothing);
}

TEST_CASE("a file is hashed as its bytes are, also in the background", "[sha256]") {
  const gonio::test::TemporaryFolder folder;
  gonio::write_file_atomically(folder / "million", std::string(1'000'000, 'a'));
  gonio::write_file_atomically(folder / "empty", "");
  CHECK(gonio::sha256_of_file(folder / "million") == of_million_a);
  CHECK(gonio::sha256_of_file(folder / "empty") == of_nothing);
  const gonio::HashedInput input = gonio::hash_in_background(folder / "million");
  CHECK(input.path == (folder / "million").string());
  CHECK(input.sha256.get() == of_million_a);
}

TEST_CASE("a file that cannot be read is an input error, also in the background", "[sha256]") {
  const gonio::test::TemporaryFolder folder;
  CHECK_THROWS_AS(gonio::sha256_of_file(folder / "missing"), gonio::Error);
  CHECK_THROWS_AS(gonio::sha256_of_file(folder.path()), gonio::Error);
  CHECK_THROWS_AS(gonio::hash_in_background(folder / "missing").sha256.get(), gonio::Error);
}
