// SPDX-License-Identifier: BSD-3-Clause
// gonio export to every renderer that takes parameters.
#include "tools/renderer_targets.hpp"

#include <algorithm>
#include <regex>

#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// Samples of a model with parameters over the hemisphere; `columns` copies of its value.
std::filesystem::path samples_of(const test::TemporaryFolder& folder, const std::string& model, const std::string& columns) {
  std::string directions, rows = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg," + columns + "\n";
  for (int i = 0; i <= 75; i += 15)
    for (int o = 0; o <= 80; o += 4)
      for (int phi = 0; phi <= 180; phi += 30)
        directions += std::to_string(i) + " 0 " + std::to_string(o) + " " + std::to_string(phi) + "\n";
  const auto values = run_gonio("eval " + model, directions);
  REQUIRE(values.code == 0);
  std::istringstream lines(directions), f(values.out);
  const auto copies = 1 + std::count(columns.begin(), columns.end(), ',');
  for (std::string line, value; std::getline(lines, line) && std::getline(f, value);) {
    for (char& c : line)
      if (c == ' ') c = ',';
    rows += line;
    for (int k = 0; k < copies; ++k) rows += "," + value;
    rows += "\n";
  }
  return folder.file("samples.csv", rows);
}

double misfit(const Json& notes, const std::string& fact) {
  std::smatch found;
  const std::string text = notes.at("facts").at(fact).string();
  REQUIRE(std::regex_search(text, found, std::regex("misfit ([0-9.]+)")));
  return std::stod(found[1]);
}

constexpr const char* ggx = "ggx --param rho_d=.2 --param f0=.05 --param f90=1 --param alpha=.2";

}  // namespace

TEST_CASE("every renderer takes a fit and samples, and the refit is never worse than the naive conversion") {
  const test::TemporaryFolder folder;
  const auto samples = samples_of(folder, ggx, "r,g,b"), fit = folder / "fit.json";
  REQUIRE(run_gonio("fit " + quoted(samples) + " --model ggx --out " + quoted(fit)).code == 0);
  REQUIRE(!tools::renderer_formats().empty());
  for (const auto& format : tools::renderer_formats())
    for (const auto& source : {samples, fit}) {
      const auto out = folder / ("material" + std::string(format.extension));
      const auto outcome = run_gonio("export " + quoted(source) + " --to " + format.name + " --out " + quoted(out) + " --json");
      INFO(format.name << " from " << source << "\n" << outcome.err);
      REQUIRE(outcome.code == 0);
      const Json notes = outcome.json().at("notes");
      const std::string text = test::read_file(out);
      CHECK(!text.empty());
      CHECK(std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= 0x20 && c < 0x7f); }));
      CHECK(notes.at("files").size() >= 1);
      CHECK(notes.at("facts").contains("roughness"));
      const bool read = notes.at("facts").contains("naive conversion");
      CHECK(read == (source == fit));
      const double before = misfit(notes, read ? "naive conversion" : "naive (of a GGX fit)"), after = misfit(notes, "after the refit");
      CHECK(after <= before);
      CHECK(after < 0.5);  // Radiance's lobe of another shape; the others are ten times nearer
    }
}

TEST_CASE("one channel becomes grey and is told; a fit that a target expresses exactly has no error left") {
  const test::TemporaryFolder folder;
  const auto samples = samples_of(folder, ggx, "value"), out = folder / "material.glsl";
  const auto outcome = run_gonio("export " + quoted(samples) + " --to glsl --out " + quoted(out) + " --json");
  REQUIRE(outcome.code == 0);
  const Json notes = outcome.json().at("notes");
  CHECK(misfit(notes, "after the refit") == 0);
  CHECK(notes.at("facts").at("compared at").string() == "the samples");
  bool told = false;
  for (const Json& sentence : notes.at("lost").elements()) told = told || sentence.string().find("grey") != std::string::npos;
  CHECK(told);
  CHECK(test::read_file(out).find("vec3 brdf(") != std::string::npos);
}

TEST_CASE("a sum of lobes is told to have become one") {
  const test::TemporaryFolder folder;
  const std::string two = "ggx+phong --param rho_d=.2 --param f0=.05 --param f90=1 --param alpha=.1 --param rho_s=.2 --param s=8";
  const auto samples = samples_of(folder, two, "value"), fit = folder / "fit.json", out = folder / "material.glsl";
  REQUIRE(run_gonio("fit " + quoted(samples) + " --model ggx+phong --out " + quoted(fit)).code <= 1);
  const auto outcome = run_gonio("export " + quoted(fit) + " --to glsl --out " + quoted(out));
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.out.find("ggx+phong, is a sum of 2 lobes") != std::string::npos);
  CHECK(outcome.out.find("naive (of a GGX fit)") != std::string::npos);
}

TEST_CASE("a format that nobody knows is refused with the renderers among the names; --error needs a grid") {
  const test::TemporaryFolder folder;
  const auto samples = samples_of(folder, ggx, "value");
  const auto unknown = run_gonio("export " + quoted(samples) + " --to povray --out x");
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("mitsuba") != std::string::npos);
  CHECK(run_gonio("export " + quoted(samples) + " --to glsl --error 1% --out x").code == 2);
}
