// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/exr_image.hpp"

#include "brdf/error.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("A picture is an OpenEXR file with its channels and attributes; a name that cannot be written leaves nothing") {
  const test::TemporaryFolder folder;
  const ExrImage image{2, 2, {{"Y", {1, 2, 3, 4}}, {"f.550nm", {0, 0, 0, 0}}}, {{"theta_i_deg", "30"}}};
  write_exr_image(image, folder / "a.exr");
  const std::string bytes = test::read_file(folder / "a.exr");
  CHECK(bytes.starts_with("\x76\x2f\x31\x01"));  // the magic number of the format
  for (const char* text : {"f.550nm", "gonio.theta_i_deg"}) CHECK(bytes.find(text) != std::string::npos);
  CHECK_THROWS_AS(write_exr_image(image, folder / "no" / "such" / "folder.exr"), Error);
  CHECK_THROWS_AS(write_exr_image(ExrImage{0, 0, {}, {}}, folder / "b.exr"), Error);
  CHECK_FALSE(std::filesystem::exists(folder / "b.exr"));
}
