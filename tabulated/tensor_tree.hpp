// SPDX-License-Identifier: BSD-3-Clause
// A function on the unit cube of 3 or 4 dimensions, constant over cells of different sizes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tabulated/formats/scattering_text.hpp"

namespace gonio::tabulated {

/// Every node halves its cube in every dimension, or is a regular grid of values. In Radiance's text a node is `{ child child … }` with
/// the children counted in binary, bit i = upper half of dimension i, or `{ value value … }` with 2^(k · dimensions) values of which
/// the *last* dimension varies fastest. One value is a grid with k = 0. Values are floats.
class TensorTree {
 public:
  static constexpr std::size_t max_dimensions = 4;
  /// Cells of half a millionth: finer than any file's digits.
  static constexpr std::size_t max_depth = 20;
  using Position = std::array<double, max_dimensions>;

  /// A constant.
  explicit TensorTree(std::size_t dimensions, float value = 0);
  /// From 2^dimensions children in the order of the text.
  static TensorTree of_children(std::vector<TensorTree> children);

  /// The text that `parse_tensor_tree` reads; every number reads back to the same float.
  std::string text() const;

  std::size_t dimensions() const noexcept { return dimensions_; }
  std::size_t leaf_count() const noexcept { return values_.size(); }
  bool is_constant() const noexcept { return nodes_.size() == 1 && nodes_[0].log2_grid == 0; }
  const std::vector<float>& values() const noexcept { return values_; }

  /// The value of the cell a position of [0, 1]^dimensions lies in.
  float at(const Position& position) const noexcept;
  /// Calls `visit(corner, edge, value)` for every cell.
  void visit(const std::function<void(const Position& corner, double edge, float value)>& visit) const;

 private:
  struct Node {
    std::uint32_t first = 0;      ///< of its values or its children, which lie together
    std::int32_t log2_grid = -1;  ///< -1: has children
  };
  struct Reader;
  friend struct ParsedTree;
  void visit_node(std::size_t node, const Position& corner, double edge,
                  const std::function<void(const Position&, double, float)>& visit) const;
  void append_text(std::size_t node, std::size_t depth, std::string& out) const;

  std::size_t dimensions_;
  std::vector<Node> nodes_;  ///< the root is the first
  std::vector<float> values_;
};

/// Radiance's text as a tree; nothing and the fault if it is none. Negative values become 0, as Radiance has it, and are counted.
struct ParsedTree {
  ParsedTree(std::string_view text, std::size_t dimensions);

  std::optional<TensorTree> tree;
  TextFault fault;
  std::size_t negative = 0;
};

}  // namespace gonio::tabulated
