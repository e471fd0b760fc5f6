// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/rgl_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tabulated/in_parallel.hpp"

namespace gonio::tabulated {
namespace {

constexpr std::size_t pair_count = 20000, block_size = 1000;
constexpr double widest_deg = 80;
constexpr double least_part_of_mean = 1e-3;

}  // namespace

double mean_relative_error(const Brdf& source, const ChannelMap& map, const Brdf& table, int threads) {
  std::mt19937_64 random(1);  // the same pairs for every table
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const double lowest = std::cos(widest_deg * std::numbers::pi / 180);
  const auto direction = [&] {
    const double z = lowest + (1 - lowest) * uniform(), phi = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
    return Direction::trusted(r * std::cos(phi), r * std::sin(phi), z);
  };
  std::vector<Direction> wi, wo;
  for (std::size_t k = 0; k < pair_count; ++k) wi.push_back(direction()), wo.push_back(direction());

  const std::size_t from = source.channels().size(), to = map.to.size();
  std::vector<double> in(pair_count * from), wanted(pair_count * to), found(pair_count * to);
  in_parallel(pair_count / block_size, threads, [&](std::size_t block) {
    const std::size_t first = block * block_size;
    const auto i = std::span(wi).subspan(first, block_size), o = std::span(wo).subspan(first, block_size);
    source.eval(i, o, std::span(in).subspan(first * from, block_size * from));
    table.eval(i, o, std::span(found).subspan(first * to, block_size * to));
    for (std::size_t k = first; k < first + block_size; ++k) map.apply(in.data() + k * from, wanted.data() + k * to);
  });

  double sum = 0, error = 0;
  std::size_t count = 0;
  for (const double f : wanted)
    if (f >= 0) sum += f, ++count;
  const double least = least_part_of_mean * sum / static_cast<double>(count);
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (wanted[k] >= 0) error += std::fabs(found[k] - wanted[k]) / std::max(wanted[k], least);
  return count > 0 && sum > 0 ? error / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace gonio::tabulated
