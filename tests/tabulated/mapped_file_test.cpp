// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/mapped_file.hpp"

#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

TEST_CASE("A mapping shows the bytes of the file, or none for an empty one") {
  const TemporaryFolder scratch;
  const MappedFile file(scratch.file("three", "abc"));
  REQUIRE(file.bytes().size() == 3);
  CHECK(file.bytes()[2] == std::byte{'c'});
  CHECK(MappedFile(scratch.file("none", "")).bytes().empty());
}

TEST_CASE("What cannot be mapped is an error that names it") {
  const TemporaryFolder scratch;
  CHECK(faults_of([&] { MappedFile file(scratch / "nothing"); }).find("nothing|No such file") != std::string::npos);
  CHECK_FALSE(faults_of([&] { MappedFile file(scratch.path()); }).empty());
}
