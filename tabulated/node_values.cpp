// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/node_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "brdf/error.hpp"
#include "tabulated/in_parallel.hpp"

namespace gonio::tabulated {
namespace {

/// Large enough for a batch to pay, small enough to share out evenly.
constexpr std::size_t block_size = 4096;

}  // namespace

NodeValues node_values(const Opened& source, std::span<const Direction> wi, std::span<const Direction> wo, int threads,
                       ExportNotes& notes) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {"the source", fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  NodeValues out;
  const std::size_t n = wi.size(), channels = out.channel_count = source.brdf->channels().size();
  out.f.resize(n * channels);
  if (source.uncertain) out.u.resize(n * channels), out.coverage.resize(n);

  std::atomic<std::size_t> unknown{0}, negative{0}, extrapolated{0};
  in_parallel((n + block_size - 1) / block_size, threads, [&](std::size_t block) {
    const std::size_t first = block * block_size, count = std::min(block_size, n - first);
    const std::span<double> f = std::span(out.f).subspan(first * channels, count * channels);
    if (source.uncertain)
      source.uncertain->eval_with_uncertainty(wi.subspan(first, count), wo.subspan(first, count), f,
                                              std::span(out.u).subspan(first * channels, count * channels),
                                              std::span(out.coverage).subspan(first, count));
    else
      source.brdf->eval(wi.subspan(first, count), wo.subspan(first, count), f);
    for (std::size_t k = 0; k < count; ++k) {
      const auto values = f.subspan(k * channels, channels);
      if (std::any_of(values.begin(), values.end(), [](double value) { return std::isinf(value); }))
        throw Error(ErrorKind::input, {"the BRDF to be written", fmt::format("an infinite value at node {}", first + k), "finite values"});
      if (std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
        ++unknown;
      else if (std::any_of(values.begin(), values.end(), [](double value) { return value < 0; }))
        ++negative;
      if (source.uncertain && out.coverage[first + k] == Coverage::extrapolated) ++extrapolated;
    }
  });
  notes.n_nodes += n;
  notes.n_unknown += unknown;
  notes.n_negative += negative;
  notes.n_extrapolated += extrapolated;
  return out;
}

}  // namespace gonio::tabulated
