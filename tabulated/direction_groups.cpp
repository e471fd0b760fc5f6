// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/direction_groups.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace gonio::tabulated {
namespace {

using CellKey = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const CellKey& key) const noexcept {
    std::uint64_t hash = 0;
    for (const std::int64_t part : key) hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

double distance(const Direction& a, const Direction& b) { return std::hypot(a.x() - b.x(), a.y() - b.y(), a.z() - b.z()); }

}  // namespace

DirectionGroups group_directions(const std::vector<Direction>& directions, double tolerance_rad) {
  DirectionGroups out;
  out.group.reserve(directions.size());
  std::unordered_map<CellKey, std::vector<std::size_t>, CellHash> founders;  // groups by the cell of their founder
  const auto cell_of = [&](const Direction& d) {
    const auto part = [&](double x) { return static_cast<std::int64_t>(std::floor(x / tolerance_rad)); };
    return CellKey{part(d.x()), part(d.y()), part(d.z())};
  };
  const auto find = [&](const Direction& d, const CellKey& centre) -> std::size_t {
    std::size_t found = out.first.size();
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto cell = founders.find({centre[0] + x, centre[1] + y, centre[2] + z});
          if (cell == founders.end()) continue;
          for (const std::size_t group : cell->second)
            if (group < found && distance(directions[out.first[group]], d) < tolerance_rad) found = group;
        }
    return found;
  };
  for (std::size_t k = 0; k < directions.size(); ++k) {
    // Plans run through one arm while the other rests: mostly the direction is that of the sample before.
    if (k > 0 && directions[k] == directions[k - 1]) {
      out.group.push_back(out.group.back());
      continue;
    }
    const CellKey cell = cell_of(directions[k]);
    const std::size_t group = find(directions[k], cell);
    if (group == out.first.size()) {
      out.first.push_back(k);
      founders[cell].push_back(group);
    }
    out.group.push_back(group);
  }
  return out;
}

}  // namespace gonio::tabulated
