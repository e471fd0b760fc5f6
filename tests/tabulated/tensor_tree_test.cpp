// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/tensor_tree.hpp"

#include <cmath>

#include "tests/random_directions.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

TensorTree tree(const std::string& text, std::size_t dimensions) {
  ParsedTree parsed(text, dimensions);
  INFO(parsed.fault.found << ", wanted " << parsed.fault.wanted);
  REQUIRE(parsed.tree);
  return *parsed.tree;
}

std::string fault(const std::string& text, std::size_t dimensions) {
  const ParsedTree parsed(text, dimensions);
  return parsed.tree ? "" : parsed.fault.found + ", wanted " + parsed.fault.wanted;
}

/// A tree of constants, deeper here than there.
TensorTree random_tree(test::Random& random, std::size_t dimensions, int depth) {
  if (depth == 0 || test::uniform(random, 0, 1) < 0.4) return TensorTree(dimensions, static_cast<float>(test::uniform(random, 0, 10)));
  std::vector<TensorTree> children;
  for (std::size_t k = 0; k < std::size_t{1} << dimensions; ++k) children.push_back(random_tree(random, dimensions, depth - 1));
  return TensorTree::of_children(std::move(children));
}

}  // namespace

TEST_CASE("Children are counted in binary, the first dimension lowest; in grids the last dimension runs fastest") {
  const TensorTree branches = tree("{ {0} {1} {2} {3} {4} {5} {6} {7} }", 3);
  const TensorTree grid = tree("{ 0 1 2 3 4 5 6 7 }", 3);
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z) {
        const TensorTree::Position at{0.2 + 0.5 * x, 0.3 + 0.5 * y, 0.4 + 0.5 * z, 0};
        CHECK(branches.at(at) == static_cast<float>(x + 2 * y + 4 * z));
        CHECK(grid.at(at) == static_cast<float>(4 * x + 2 * y + z));
      }
  CHECK(tree("{ 7.5 }", 4).at({0.1, 0.9, 0.4, 1.0}) == 7.5f);
}

TEST_CASE("A tree written and read again is the same function, to the bit") {
  test::Random random(test::seed);
  for (const std::size_t dimensions : {3u, 4u}) {
    const TensorTree original = random_tree(random, dimensions, 4);
    const TensorTree again = tree(original.text(), dimensions);
    CHECK(again.leaf_count() == original.leaf_count());
    for (int k = 0; k < 5000; ++k) {
      TensorTree::Position at{};
      for (std::size_t i = 0; i < dimensions; ++i) at[i] = test::uniform(random, 0, 1);
      CHECK(again.at(at) == original.at(at));
    }
  }
}

TEST_CASE("The cells that are visited fill the cube and have the values found at their centres") {
  test::Random random(test::seed);
  const TensorTree mixed =
      tree("{ {1} {2} {3 4 5 6 7 8 9 10} {1} {1} {" + random_tree(random, 3, 2).text() + "{1}{1}{1}{1}{1}{1}{1}} {1} {1} }", 3);
  double volume = 0;
  mixed.visit([&](const TensorTree::Position& corner, double edge, float value) {
    volume += edge * edge * edge;
    CHECK(mixed.at({corner[0] + edge / 2, corner[1] + edge / 2, corner[2] + edge / 2, 0}) == value);
  });
  CHECK(volume == Approx(1).epsilon(1e-14));
}

TEST_CASE("A text that is no tree is refused with what was wanted") {
  CHECK(fault("", 3).find("wanted '{'") != std::string::npos);
  CHECK(fault("{ 1 2 3 }", 3).find("3 values in a node, wanted a power of 8") != std::string::npos);
  CHECK(fault("{ }", 3).find("0 values") != std::string::npos);
  CHECK(fault("{ 1 ", 3).find("wanted '}'") != std::string::npos);
  CHECK(fault("{ {1} {2} }", 3).find("wanted '{'") != std::string::npos);
  CHECK(fault("{ 1 } 2", 3).find("wanted the end") != std::string::npos);
  CHECK(fault("{ 1x }", 3).find("'1x") != std::string::npos);
  CHECK(fault("{ 1e300 }", 3).find("a float can hold") != std::string::npos);
  CHECK(fault(std::string(100000, '{'), 4).find("at most 20 levels") != std::string::npos);
  CHECK(ParsedTree("{ -1 }", 3).negative == 1);
  CHECK(tree("{ -1 }", 3).at({}) == 0);
}
