// SPDX-License-Identifier: BSD-3-Clause
// How far the files we write are from their source, by an evaluator that shares nothing with writer and reader.
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "tabulated/formats/rgl.hpp"
#include "tests/random_directions.hpp"
#include "tests/shared_data.hpp"
#include "tests/tabulated/ggx_anisotropic.hpp"
#include "tests/tabulated/reference_rgl.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

Opened source_of(std::shared_ptr<const Brdf> brdf) {
  Opened out;
  out.format = "model";
  out.brdf = std::move(brdf);
  return out;
}

Opened model(const char* name, std::vector<double> values) {
  return source_of(std::make_shared<AnalyticBrdf>(name, single_channel("value"), std::vector<std::vector<double>>{std::move(values)}));
}

RglArrays written(const Opened& source, GridSize size) {
  const test::TemporaryFolder folder;
  WriteOptions options;
  options.size = size;
  write_rgl_rgb(source, folder / "m.bsdf", options);
  return read_rgl(folder / "m.bsdf");
}

/// A pair within 80 degrees of the normal.
DirectionPair random_pair(test::Random& random) {
  const auto direction = [&] {
    Direction w;
    do w = test::upper_direction(random);
    while (w.theta().degrees() > 80);
    return w;
  };
  const Direction wi = direction();
  return {wi, direction()};
}

/// Prints what it finds: these are the figures of docs/formats.md.
double mean_error(const char* what, const Opened& source, GridSize size) {
  constexpr int pairs = 2000;
  const test::ReferenceRgl reference(written(source, size));
  test::Random random(test::seed);
  double sum = 0;
  for (int k = 0; k < pairs; ++k) {
    const auto [wi, wo] = random_pair(random);
    const double f = source.brdf->eval(wi, wo)[0];
    sum += std::fabs(reference.eval(wi, wo)[0] - f) / f;
  }
  WARN(what << (size == GridSize::fine ? ", fine: " : size == GridSize::paper ? ", paper: " : ", standard: ") << 100 * sum / pairs << " %");
  return sum / pairs;
}

/// Mean excess of f cos theta_o over the source's, for light that grazes the surface within 4 degrees, in parts of rho_d / pi.
double seam(const Opened& source, double rho_d) {
  constexpr int pairs = 4000;
  const test::ReferenceRgl reference(written(source, GridSize::standard));
  test::Random random(test::seed);
  double sum = 0;
  for (int k = 0; k < pairs; ++k) {
    const Direction wi = random_pair(random).wi;
    const Direction wo =
        GonioAngles{0_deg, 0_deg, degrees(test::uniform(random, 86, 89.9)), degrees(test::uniform(random, -180, 180))}.wo();
    sum += (reference.eval(wi, wo)[0] - source.brdf->eval(wi, wo)[0]) * wo.z();
  }
  return sum / pairs / (rho_d / std::numbers::pi);
}

}  // namespace

TEST_CASE("Written files are within 1 % of a GGX surface at the standard size and 0.3 % at the fine one, on average") {
  for (const double alpha : {0.1, 0.15, 0.2, 0.4, 0.8}) {
    const Opened source = model("ggx", {0, 0.9, 1, alpha});
    const std::string name = fmt::format("GGX {}", alpha);
    INFO(name << ", seed " << test::seed);
    CHECK(mean_error(name.c_str(), source, GridSize::standard) < 0.01);
    CHECK(mean_error(name.c_str(), source, GridSize::fine) < 0.003);
  }
  CHECK(mean_error("matt and GGX 0.3", model("ggx", {0.4, 0.04, 1, 0.3}), GridSize::standard) < 0.01);
  CHECK(mean_error("Lambert", model("lambert", {0.5}), GridSize::standard) < 0.01);
}

TEST_CASE("Written files are within 1 % of an anisotropic surface at the standard size, on average") {
  CHECK(mean_error("anisotropic GGX", source_of(std::make_shared<test::GgxAnisotropic>(0.15, 0.4)), GridSize::standard) < 0.01);
  CHECK(mean_error("Ward", model("ward-duer-gm-anisotropic", {0.2, 0.4, 0.15, 0.4}), GridSize::standard) < 0.01);
}

TEST_CASE("Grazing light is 0 at the horizon, so that no seam lies along the terminator of a body") {
  // Where the density of half vectors is small and the cells are large: with the value of the horizon below it, the excess is 0.016.
  CHECK(std::fabs(seam(model("blinn-phong", {0.25, 0.35, 60}), 0.25)) < 0.006);
}

TEST_CASE("The table and the independent evaluator give the same values, for files of ours and of the database") {
  std::vector<std::pair<const char*, RglArrays>> files{
      {"GGX", written(model("ggx", {0.1, 0.5, 1, 0.2}), GridSize::paper)},
      {"anisotropic GGX", written(source_of(std::make_shared<test::GgxAnisotropic>(0.15, 0.4)), GridSize::paper)}};
  if (const auto path = test::measured_data("rgl/cc_ibiza_sunset_rgb.bsdf")) files.emplace_back("cc_ibiza_sunset", read_rgl(*path));
  for (const auto& [name, arrays] : files) {
    const RglTable table(arrays);
    const test::ReferenceRgl reference(arrays);
    test::Random random(test::seed);
    for (int k = 0; k < 500; ++k) {
      const auto [wi, wo] = random_pair(random);
      const auto a = table.eval(wi, wo), b = reference.eval(wi, wo);
      INFO(name << ", pair " << k << ", seed " << test::seed);
      for (std::size_t c = 0; c < 3; ++c) CHECK(std::fabs(a[c] - b[c]) <= 1e-9 * (std::fabs(b[c]) + 1e-3));
    }
  }
}
