// SPDX-License-Identifier: BSD-3-Clause
// Atomic writes: whole or not at all.
#include "data-schemas/write_file.hpp"

#include <sys/stat.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using gonio::write_file_atomically;
namespace fs = std::filesystem;

namespace {

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a file is written and replaced whole", "[write_file]") {
  const gonio::test::TemporaryFolder folder;
  const std::string bytes("a\0b\n", 4);
  write_file_atomically(folder / "f", bytes);
  CHECK(gonio::read_file(folder / "f") == bytes);
  write_file_atomically(folder / "f", "new");
  CHECK(gonio::read_file(folder / "f") == "new");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a write that fails leaves nothing behind and the old file untouched", "[write_file]") {
  const gonio::test::TemporaryFolder folder;
  CHECK_THROWS_AS(write_file_atomically(folder / "missing" / "f", "x"), gonio::Error);
  CHECK_FALSE(fs::exists(folder / "missing"));
  write_file_atomically(folder / "file", "old");
  CHECK_THROWS_AS(write_file_atomically(folder / "file" / "f", "x"), gonio::Error);
  fs::create_directory(folder / "folder");
  CHECK_THROWS_AS(write_file_atomically(folder / "folder", "x"), gonio::Error);
  CHECK_THROWS_AS(write_file_atomically(folder / std::string(300, 'n'), "x"), gonio::Error);
  CHECK_THROWS_AS(write_file_atomically("", "x"), gonio::Error);
  CHECK(gonio::read_file(folder / "file") == "old");
  CHECK(files_in(folder.path()) == 2);
}

TEST_CASE("a full device is an input error", "[write_file]") {
  if (!fs::exists("/dev/full")) {
    WARN("no /dev/full here");
    return;
  }
  CHECK_THROWS_AS(write_file_atomically("/dev/full", "x"), gonio::Error);
}

TEST_CASE("a link is followed and a device is not replaced", "[write_file]") {
  const gonio::test::TemporaryFolder folder;
  write_file_atomically(folder / "target", "old");
  fs::create_symlink("target", folder / "link");
  write_file_atomically(folder / "link", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(gonio::read_file(folder / "target") == "new");
  write_file_atomically("/dev/null", "x");
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a reader sees the old bytes or the new ones, never a part", "[write_file]") {
  const gonio::test::TemporaryFolder folder;
  constexpr std::size_t size = 1 << 16;
  write_file_atomically(folder / "f", std::string(size, 'a'));
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (int i = 0; i < 50; ++i) write_file_atomically(folder / "f", std::string(size, i % 2 == 0 ? 'b' : 'a'));
    done = true;
  });
  bool whole = true;
  while (!done) {
    const std::string seen = gonio::read_file(folder / "f");
    whole = whole && seen.size() == size && seen.find_first_not_of(seen[0]) == seen.npos;
  }
  writer.join();
  CHECK(whole);
}
