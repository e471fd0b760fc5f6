// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/replace_file.hpp"

#include "tests/check.hpp"
#include "tests/tabulated/scratch.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::tests::contents;
using gonio::tests::faults_of;
using gonio::tests::Scratch;

TEST_CASE("A file is replaced whole or not at all") {
  const Scratch scratch;
  const auto path = scratch.file("result", "old");
  CHECK_FALSE(faults_of([&] {
                replace_file(path, [](const std::filesystem::path& temporary) {
                  std::ofstream(temporary) << "half";
                  throw Error(ErrorKind::input, {"x", "y", "z"});
                });
              }).empty());
  CHECK(contents(path) == "old");
  replace_file(path, [](const std::filesystem::path& temporary) { std::ofstream(temporary) << "new"; });
  CHECK(contents(path) == "new");
  CHECK(std::distance(std::filesystem::directory_iterator(scratch.folder()), std::filesystem::directory_iterator()) == 1);
}
