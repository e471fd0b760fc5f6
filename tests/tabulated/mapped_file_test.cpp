// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/mapped_file.hpp"

#include "tests/tabulated/scratch.hpp"

#include "tests/check.hpp"

using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::Scratch;

TEST_CASE("A mapping shows the bytes of the file, or none for an empty one") {
  const Scratch scratch;
  const MappedFile file(scratch.file("three", "abc"));
  REQUIRE(file.bytes().size() == 3);
  CHECK(file.bytes()[2] == std::byte{'c'});
  CHECK(MappedFile(scratch.file("none", "")).bytes().empty());
}

TEST_CASE("What cannot be mapped is an error that names it") {
  const Scratch scratch;
  CHECK(faults_of([&] { MappedFile file(scratch / "nothing"); }).find("nothing|No such file") != std::string::npos);
  CHECK_FALSE(faults_of([&] { MappedFile file(scratch.folder()); }).empty());
}
