// SPDX-License-Identifier: BSD-3-Clause
// The table of models in docs/models.md says what the code says, and the README leads to it.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "brdf/model_info.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(std::string(GONIO_SOURCE_DIR) + "/" + path);
  std::ostringstream out;
  out << file.rdbuf();
  return out.str();
}

/// The cells of the rows that start with a name in back quotes.
std::vector<std::vector<std::string>> rows(const std::string& text) {
  std::vector<std::vector<std::string>> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    for (std::size_t from = 2; from < line.size();) {
      const std::size_t to = line.find(" | ", from) == std::string::npos ? line.size() - 2 : line.find(" | ", from);
      cells.push_back(line.substr(from, to - from));
      from = to + 3;
    }
    out.push_back(cells);
  }
  return out;
}

}  // namespace

TEST_CASE("docs/models.md has a row for every model with its parameters, properties and source") {
  const auto table = rows(text_of("docs/models.md"));
  REQUIRE(table.size() == model_infos().size());
  for (std::size_t k = 0; k < table.size(); ++k) {
    const ModelInfo& info = model_infos()[k];
    INFO(info.name);
    REQUIRE(table[k].size() == 5);
    CHECK(table[k][0] == "`" + info.name + "`");
    CHECK_FALSE(table[k][1].empty());
    std::string parameters, properties;
    for (const Parameter& p : info.parameters) parameters += (parameters.empty() ? "`" : " `") + std::string(p.name) + "`";
    CHECK(table[k][2] == parameters);
    const auto add = [&](bool has, const char* word) {
      if (has) properties += (properties.empty() ? "" : ", ") + std::string(word);
    };
    add(info.properties.reciprocal, "reciprocal"), add(info.properties.isotropic, "isotropic");
    add(info.properties.bilateral, "bilateral"), add(info.properties.bounded, "bounded");
    CHECK(table[k][3] == properties);
    CHECK(table[k][4] == info.citation);
  }
}

TEST_CASE("the README leads to the table of models") { CHECK(text_of("README.md").find("(docs/models.md)") != std::string::npos); }
