// SPDX-License-Identifier: BSD-3-Clause
#include "tools/tradeoff/tradeoff.hpp"

#include <algorithm>
#include <filesystem>

#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

TEST_CASE("every topic writes a valid document, the same points as CSV, and two pictures") {
  for (const tools::tradeoff::Topic& topic : tools::tradeoff::topics()) {
    INFO(topic.name);
    const test::TemporaryFolder folder;
    const std::string name(topic.name);
    const auto outcome = run_gonio("tradeoff " + name + " --quick --quiet --json --out '" + folder.path().string() + "'");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const Json document = load_document(folder / (name + ".json"), Schema::tradeoff);
    CHECK(document == outcome.json());
    const auto& points = document.at("points").elements();
    const std::string csv = read_file(folder / (name + ".csv"));
    CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == points.size() + 1);
    for (const Json& panel : document.at("panels").elements()) {
      INFO(panel.at("name").string());
      CHECK(std::any_of(points.begin(), points.end(),
                        [&](const Json& p) { return p.at("panel") == panel.at("name") && p.at("on_front").boolean(); }));
    }
    CHECK(read_file(folder / (name + ".png")).starts_with("\x89PNG"));
    CHECK(read_file(folder / (name + ".svg")).find("<svg") != std::string::npos);
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 4);
  }
}

TEST_CASE("an unknown topic and a folder that cannot be made are refused") {
  const auto unknown = run_gonio("tradeoff speed --out /tmp");
  CHECK(unknown.code == 2);
  CHECK(unknown.err.find("albedo") != std::string::npos);
  CHECK(run_gonio("tradeoff albedo").code == 2);
  CHECK(run_gonio("tradeoff albedo --quick --out /dev/null/there").code == 3);
}
