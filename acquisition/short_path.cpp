// SPDX-License-Identifier: BSD-3-Clause
// Nearest neighbour, 2-opt, Or-opt; Prim's tree.
#include "acquisition/short_path.hpp"

#include <algorithm>
#include <limits>

namespace gonio::acquisition {
namespace {

constexpr std::size_t neighbour_count = 10;  // candidates of a move per point; more change paths of grids and spirals by less than 1 %
constexpr std::size_t longest_segment = 3;   // of an Or-opt move
constexpr int max_rounds = 60;               // each over all points; a few suffice
constexpr double least_gain = 1e-12;         // relative; smaller gains are rounding and could go on for ever
constexpr double infinity = std::numeric_limits<double>::infinity();

class Path {
 public:
  Path(std::size_t n, const Distance& distance, const std::function<double(std::size_t)>& from_start)
      : n_(n), distance_(distance), from_start_(from_start), neighbours_(n) {
    go_to_nearest();
    find_neighbours();
  }

  void improve() {
    for (int round = 0; round < max_rounds; ++round) {
      bool better = false;
      for (std::size_t node = 0; node < n_; ++node) better = reverse_for(node) || move_for(node) || better;
      better = reverse_tail() || better;
      if (!better) return;
    }
  }

  const std::vector<std::size_t>& order() const { return path_; }

 private:
  void go_to_nearest() {
    std::vector<std::size_t> left(n_);
    for (std::size_t k = 0; k < n_; ++k) left[k] = k;
    while (!left.empty()) {
      std::size_t best = 0;
      double least = infinity;
      for (std::size_t k = 0; k < left.size(); ++k) {
        const double d = path_.empty() ? from_start_(left[k]) : distance_(path_.back(), left[k]);
        if (d < least || (d == least && left[k] < left[best])) least = d, best = k;
      }
      path_.push_back(left[best]);
      left[best] = left.back();
      left.pop_back();
    }
    place_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) place_[path_[k]] = k;
  }

  void find_neighbours() {
    std::vector<std::pair<double, std::size_t>> row;
    for (std::size_t a = 0; a < n_; ++a) {
      row.clear();
      for (std::size_t b = 0; b < n_; ++b)
        if (b != a) row.emplace_back(distance_(a, b), b);
      const auto end = row.begin() + static_cast<std::ptrdiff_t>(std::min(neighbour_count, row.size()));
      std::partial_sort(row.begin(), end, row.end());
      for (auto near = row.begin(); near != end; ++near) neighbours_[a].push_back(near->second);
    }
  }

  /// The edge that ends at place k; place n is beyond the end and costs nothing.
  double edge(std::size_t k) const { return k == n_ ? 0 : k == 0 ? from_start_(path_[0]) : distance_(path_[k - 1], path_[k]); }
  /// What an edge from place k (-1: the start) to a node would cost.
  double from(std::ptrdiff_t k, std::size_t node) const {
    return k < 0 ? from_start_(node) : distance_(path_[static_cast<std::size_t>(k)], node);
  }
  bool gains(double before, double after) const { return before - after > least_gain * (before + after); }

  void put(std::size_t first, std::size_t last) {
    for (std::size_t k = first; k <= last; ++k) place_[path_[k]] = k;
  }
  void reverse(std::size_t first, std::size_t last) {
    std::reverse(path_.begin() + static_cast<std::ptrdiff_t>(first), path_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    put(first, last);
  }

  /// 2-opt: joins `node` to a near one by turning round what lies between them.
  bool reverse_for(std::size_t node) {
    for (const std::size_t near : neighbours_[node]) {
      const std::size_t a = std::min(place_[node], place_[near]), b = std::max(place_[node], place_[near]);
      // Joined at their left ends: a..b with a+1..b turned; at their right ends: a..b-1 turned.
      if (b > a + 1) {
        const double tail = b + 1 < n_ ? distance_(path_[a + 1], path_[b + 1]) : 0;
        if (gains(edge(a + 1) + edge(b + 1), distance_(path_[a], path_[b]) + tail)) return reverse(a + 1, b), true;
        if (gains(edge(a) + edge(b), from(static_cast<std::ptrdiff_t>(a) - 1, path_[b - 1]) + distance_(path_[a], path_[b])))
          return reverse(a, b - 1), true;
      }
    }
    return false;
  }

  /// 2-opt at the free end: turns round the tail after the place where that gains most.
  bool reverse_tail() {
    for (std::size_t k = 0; k + 1 < n_; ++k)
      if (gains(edge(k), from(static_cast<std::ptrdiff_t>(k) - 1, path_[n_ - 1]))) return reverse(k, n_ - 1), true;
    return false;
  }

  /// Or-opt: puts up to three points that begin at `node` beside a near one, either way round.
  bool move_for(std::size_t node) {
    const std::size_t first = place_[node];
    for (std::size_t length = 1; length <= longest_segment && first + length <= n_; ++length) {
      const std::size_t last = first + length - 1;
      const double bridge = last + 1 < n_ ? from(static_cast<std::ptrdiff_t>(first) - 1, path_[last + 1]) : 0;
      const double freed = edge(first) + edge(last + 1) - bridge;
      for (const std::size_t near : neighbours_[node]) {
        const std::size_t at = place_[near];
        if (at >= first && at <= last) continue;
        // After `near` the segment keeps its sense, before it it is turned: `node` stands beside `near` both times.
        if (at + 1 != first) {
          const bool free_end = at + 1 == n_;
          const double cut = free_end ? 0 : edge(at + 1);
          const double joined = distance_(path_[at], path_[first]) + (free_end ? 0 : distance_(path_[last], path_[at + 1]));
          if (gains(freed + cut, joined)) return move(first, last, at + 1, false), true;
        }
        if (at != last + 1) {
          const double joined = from(static_cast<std::ptrdiff_t>(at) - 1, path_[last]) + distance_(path_[first], path_[at]);
          if (gains(freed + edge(at), joined)) return move(first, last, at, true), true;
        }
      }
    }
    return false;
  }

  /// Moves places first..last to stand before what is now at place `before`.
  void move(std::size_t first, std::size_t last, std::size_t before, bool turned) {
    const auto begin = path_.begin();
    const auto f = static_cast<std::ptrdiff_t>(first), l = static_cast<std::ptrdiff_t>(last) + 1, b = static_cast<std::ptrdiff_t>(before);
    if (turned) std::reverse(begin + f, begin + l);
    if (b > l)
      std::rotate(begin + f, begin + l, begin + b);
    else
      std::rotate(begin + b, begin + f, begin + l);
    put(std::min(first, before), std::max(last, before == 0 ? 0 : before - 1));
  }

  std::size_t n_;
  const Distance& distance_;
  const std::function<double(std::size_t)>& from_start_;
  std::vector<std::size_t> path_, place_;
  std::vector<std::vector<std::size_t>> neighbours_;
};

}  // namespace

std::vector<std::size_t> short_path(std::size_t n, const Distance& distance, const std::function<double(std::size_t)>& from_start) {
  if (n == 0) return {};
  Path path(n, distance, from_start);
  path.improve();
  return path.order();
}

double spanning_tree_length(std::size_t n, const Distance& distance) {
  std::vector<double> nearest(n, infinity);
  std::vector<bool> inside(n, false);
  double length = 0;
  for (std::size_t newest = 0, count = 1; count < n; ++count) {
    inside[newest] = true;
    std::size_t next = n;
    for (std::size_t k = 0; k < n; ++k) {
      if (inside[k]) continue;
      nearest[k] = std::min(nearest[k], distance(newest, k));
      if (next == n || nearest[k] < nearest[next]) next = k;
    }
    length += nearest[next];
    newest = next;
  }
  return length;
}

}  // namespace gonio::acquisition
