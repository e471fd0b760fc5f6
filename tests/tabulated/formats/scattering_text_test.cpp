// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/scattering_text.hpp"

#include <vector>

#include "tests/check.hpp"

using namespace gonio::tabulated;

namespace {

std::vector<double> numbers(const std::string& letters, std::string& fault) {
  ScatteringText text(letters);
  std::vector<double> out;
  while (text.peek() != '\0') {
    const auto value = text.number();
    if (!value) {
      fault = text.fault().found + "@" + std::to_string(text.fault().offset);
      break;
    }
    out.push_back(*value);
  }
  return out;
}

}  // namespace

TEST_CASE("Blanks, commas and one comma after the last number separate numbers") {
  std::string fault;
  CHECK(numbers(" 1 2\n3,\t4 ,5e-3,\r\n6,", fault) == std::vector<double>{1, 2, 3, 4, 5e-3, 6});
  CHECK(fault.empty());
}

TEST_CASE("Anything else is a fault with its place") {
  const std::pair<const char*, const char*> cases[] = {{"1 2x 3", "'2x'@2"}, {"1,,2", "','@2"},          {"nan", "'nan'@0"},
                                                       {"1 inf", "'inf'@2"}, {"1 2 1e999", "'1e999'@4"}, {",1", "','@0"}};
  for (const auto& [letters, wanted] : cases) {
    std::string fault;
    numbers(letters, fault);
    CHECK(fault == wanted);
  }
}
