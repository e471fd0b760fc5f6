// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/tensor_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace gonio::tabulated {

TensorTree::TensorTree(std::size_t dimensions, float value) : dimensions_(dimensions), nodes_{{0, 0}}, values_{value} {}

TensorTree TensorTree::of_children(std::vector<TensorTree> children) {
  TensorTree out(children[0].dimensions_);
  out.values_.clear();
  out.nodes_.assign(1 + children.size(), {});
  out.nodes_[0] = {1, -1};
  for (std::size_t k = 0; k < children.size(); ++k) {
    const TensorTree& child = children[k];
    // The child's root moves to its place among its siblings; its other nodes follow behind everything there is.
    const auto nodes_before = static_cast<std::uint32_t>(out.nodes_.size()), values_before = static_cast<std::uint32_t>(out.values_.size());
    const auto moved = [&](Node node) {
      node.first += node.log2_grid < 0 ? nodes_before - 1 : values_before;  // node 0 of the child is not among those that follow
      return node;
    };
    out.nodes_[1 + k] = moved(child.nodes_[0]);
    std::transform(child.nodes_.begin() + 1, child.nodes_.end(), std::back_inserter(out.nodes_), moved);
    out.values_.insert(out.values_.end(), child.values_.begin(), child.values_.end());
  }
  return out;
}

/// Reads nodes; stops at the first fault.
struct TensorTree::Reader {
  ScatteringText text;
  TensorTree& tree;
  TextFault fault{};
  std::size_t negative = 0;

  bool failed(std::string wanted) {
    fault = {text.offset(), text.found(), std::move(wanted)};
    return false;
  }

  bool read(std::size_t node, std::size_t depth) {
    if (!text.take('{')) return failed("'{', the beginning of a node");
    if (!(text.peek() == '{' ? read_children(node, depth) : read_values(node, depth))) return false;
    if (!text.take('}')) return failed("'}', the end of a node");
    text.take(',');
    return true;
  }

  bool read_children(std::size_t node, std::size_t depth) {
    if (depth == max_depth) return failed(fmt::format("a tree of at most {} levels", max_depth));
    const std::size_t first = tree.nodes_.size(), count = std::size_t{1} << tree.dimensions_;
    tree.nodes_.resize(first + count);
    tree.nodes_[node] = {static_cast<std::uint32_t>(first), -1};
    for (std::size_t k = 0; k < count; ++k)
      if (!read(first + k, depth + 1)) return false;
    return true;
  }

  bool read_values(std::size_t node, std::size_t depth) {
    const std::size_t first = tree.values_.size();
    for (char next = text.peek(); next != '}' && next != '\0'; next = text.peek()) {
      const std::optional<double> value = text.number();
      if (!value) return fault = text.fault(), false;
      if (*value > std::numeric_limits<float>::max()) return failed("a number a float can hold");
      negative += *value < 0 ? 1 : 0;
      tree.values_.push_back(static_cast<float>(std::max(0.0, *value)));
    }
    const std::size_t count = tree.values_.size() - first;
    std::size_t log2_grid = 0;
    while (count > std::size_t{1} << (log2_grid * tree.dimensions_)) ++log2_grid;
    if (count != std::size_t{1} << (log2_grid * tree.dimensions_)) {
      fault = {text.offset(), fmt::format("{} values in a node", count), fmt::format("a power of {}", 1 << tree.dimensions_)};
      return false;
    }
    if (depth + log2_grid > max_depth) return failed(fmt::format("a tree of at most {} levels", max_depth));
    tree.nodes_[node] = {static_cast<std::uint32_t>(first), static_cast<std::int32_t>(log2_grid)};
    return true;
  }
};

ParsedTree::ParsedTree(std::string_view text, std::size_t dimensions) {
  TensorTree read(dimensions);
  read.values_.clear();
  TensorTree::Reader reader{ScatteringText(text), read};
  if (reader.read(0, 0) && (reader.text.peek() == '\0' || reader.failed("the end of the data"))) {
    tree = std::move(read);
    negative = reader.negative;
  }
  fault = reader.fault;
}

void TensorTree::append_text(std::size_t index, std::size_t depth, std::string& out) const {
  const Node& node = nodes_[index];
  const std::size_t count = std::size_t{1} << (node.log2_grid < 0 ? dimensions_ : static_cast<std::size_t>(node.log2_grid) * dimensions_);
  const auto is_value = [&](std::size_t k) { return nodes_[node.first + k].log2_grid == 0; };
  bool values_alone = node.log2_grid < 0;
  for (std::size_t k = 0; k < count && values_alone; ++k) values_alone = is_value(k);
  out.append(depth, ' ');
  out += '{';
  if (values_alone) {
    // As a grid, in which the last dimension runs fastest: the bits of the child's number backwards.
    for (std::size_t k = 0; k < count; ++k) {
      std::size_t child = 0;
      for (std::size_t i = 0; i < dimensions_; ++i) child |= ((k >> i) & 1) << (dimensions_ - 1 - i);
      fmt::format_to(std::back_inserter(out), "{}{}", k == 0 ? "" : " ", values_[nodes_[node.first + child].first]);
    }
  } else if (node.log2_grid < 0) {
    out += '\n';
    for (std::size_t k = 0; k < count; ++k) append_text(node.first + k, depth + 1, out);
    out.append(depth, ' ');
  } else {
    for (std::size_t k = 0; k < count; ++k) fmt::format_to(std::back_inserter(out), "{}{}", k == 0 ? "" : " ", values_[node.first + k]);
  }
  out += "}\n";
}

std::string TensorTree::text() const {
  std::string out;
  append_text(0, 0, out);
  return out;
}

float TensorTree::at(const Position& position) const noexcept {
  Position at = position;
  const Node* node = &nodes_[0];
  while (node->log2_grid < 0) {
    std::size_t child = 0;
    for (std::size_t i = 0; i < dimensions_; ++i) {
      at[i] *= 2;
      if (at[i] >= 1) child |= std::size_t{1} << i, at[i] -= 1;
    }
    node = &nodes_[node->first + child];
  }
  const auto cells = static_cast<double>(std::size_t{1} << node->log2_grid);
  std::size_t index = 0;
  for (std::size_t i = 0; i < dimensions_; ++i)
    index = (index << node->log2_grid) + static_cast<std::size_t>(std::clamp(std::floor(at[i] * cells), 0.0, cells - 1));
  return values_[node->first + index];
}

void TensorTree::visit_node(std::size_t index, const Position& corner, double edge,
                            const std::function<void(const Position&, double, float)>& visit) const {
  const Node& node = nodes_[index];
  Position at{};
  if (node.log2_grid < 0) {
    for (std::size_t child = 0; child < std::size_t{1} << dimensions_; ++child) {
      for (std::size_t i = 0; i < dimensions_; ++i) at[i] = corner[i] + ((child >> i) & 1 ? edge / 2 : 0);
      visit_node(node.first + child, at, edge / 2, visit);
    }
    return;
  }
  const auto log2 = static_cast<std::size_t>(node.log2_grid);
  const double cell = edge / static_cast<double>(std::size_t{1} << log2);
  for (std::size_t k = 0; k < std::size_t{1} << (log2 * dimensions_); ++k) {
    for (std::size_t i = 0; i < dimensions_; ++i) {
      const std::size_t step = (k >> ((dimensions_ - 1 - i) * log2)) & ((std::size_t{1} << log2) - 1);
      at[i] = corner[i] + static_cast<double>(step) * cell;
    }
    visit(at, cell, values_[node.first + k]);
  }
}

void TensorTree::visit(const std::function<void(const Position&, double, float)>& visit) const { visit_node(0, {}, 1, visit); }

}  // namespace gonio::tabulated
