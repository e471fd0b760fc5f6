// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/sphere_scene.hpp"

#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using tabulated::write_sphere_scenes;

TEST_CASE("A material file gets a scene for every renderer that loads it, with the file named relative to the scene") {
  const test::TemporaryFolder folder;
  const auto rgb = write_sphere_scenes("rgl", folder / "paint.bsdf");
  REQUIRE(rgb == std::vector{folder / "paint.xml"});
  const std::string xml = test::read_file(folder / "paint.xml");
  CHECK(xml.find("<string name=\"filename\" value=\"paint.bsdf\"/>") != std::string::npos);
  CHECK(xml.find("scalar_rgb") != std::string::npos);

  const auto spectral = write_sphere_scenes("rgl-spectral", folder / "paint-spectral.bsdf");
  REQUIRE(spectral == std::vector{folder / "paint-spectral.xml", folder / "paint-spectral.pbrt"});
  CHECK(test::read_file(folder / "paint-spectral.xml").find("scalar_spectral") != std::string::npos);
  CHECK(test::read_file(folder / "paint-spectral.pbrt").find("\"string filename\" \"paint-spectral.bsdf\"") != std::string::npos);

  CHECK(write_sphere_scenes("csv", folder / "paint.csv").empty());
}

TEST_CASE("Names with quotes, ampersands and blanks do not break a scene") {
  const test::TemporaryFolder folder;
  write_sphere_scenes("rgl-spectral", folder / "a\"&b.bsdf");
  CHECK(test::read_file(folder / "a\"&b.xml").find("a&quot;&amp;b.bsdf") != std::string::npos);
  CHECK(test::read_file(folder / "a\"&b.pbrt").find("a\\\"&b.bsdf") != std::string::npos);
  write_sphere_scenes("radiance-xml", folder / "a b.xml");
  CHECK(test::read_file(folder / "a b.rad").find("6 0 \"a b.xml\" 0 0 1 .") != std::string::npos);
}
