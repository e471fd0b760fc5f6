// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/sphere.hpp"

#include "tests/check.hpp"

using namespace gonio::tabulated::targets;

TEST_CASE("The sphere's scenes hold the comments, the material before the shape that names it, and nothing unfilled") {
  const std::string material = "what makes it\n";
  for (const std::string& scene : {mitsuba_sphere("who made it\n", material), pbrt_sphere("# who made it\n", material, "ball.exr"),
                                   radiance_sphere("# who made it\n", material)}) {
    INFO(scene);
    CHECK(scene.find("who made it\n") != std::string::npos);
    const std::size_t made = scene.find(material), used = scene.find("material", made + material.size());
    REQUIRE(made != std::string::npos);
    CHECK(used != std::string::npos);
    CHECK(scene.find("sphere", made + material.size()) != std::string::npos);
    CHECK(scene.find("{{") == std::string::npos);
  }
  CHECK(pbrt_sphere("", material, "ball.exr").find("\"ball.exr\"") != std::string::npos);
}
