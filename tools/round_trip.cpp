// SPDX-License-Identifier: BSD-3-Clause
#include "tools/round_trip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "brdf/error.hpp"
#include "tools/measured_table.hpp"

namespace gonio::tools {
namespace {

constexpr std::size_t pairs = 4000;
constexpr std::uint64_t seed = 20260701;
constexpr double least_cosine = 0.17364817766693;  // of 80°

Direction direction(std::mt19937_64& random) {
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const double z = least_cosine + (1 - least_cosine) * uniform(), phi = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
  return Direction::normalized(r * std::cos(phi), r * std::sin(phi), z);
}

}  // namespace

std::optional<RoundTrip> round_trip(const tabulated::Opened& source, const tabulated::ExportNotes& notes, const std::string& guide,
                                    int threads, std::string& reason) {
  if (!source.brdf) return reason = "the source cannot be evaluated", std::nullopt;
  const auto begin = std::chrono::steady_clock::now();
  tabulated::ReadOptions options;
  options.assume = notes.assume;
  tabulated::Opened back;
  try {
    back = tabulated::open_brdf(notes.files.front(), options);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input && error.kind() != ErrorKind::usage) throw;
    return reason = "not read back: " + std::string(error.faults().empty() ? error.what() : error.faults().front().found), std::nullopt;
  }
  RoundTrip out;
  if (is_scattered(back)) {
    TableFlags flags;
    flags.guide = guide;
    TableReport table;
    back = measured_table(back, flags, threads, table);
    const std::string& name = table.guides.front().name;  // a model and its metric
    out.guide = name.substr(0, name.find(' '));
  }
  if (!back.brdf) return reason = fmt::format("read as {}, which cannot be evaluated", back.format), std::nullopt;
  const std::size_t channels = source.brdf->channels().size(), read = back.brdf->channels().size();
  if (channels != read && channels != 1) return reason = fmt::format("{} channels became {}", channels, read), std::nullopt;

  std::mt19937_64 random(seed);
  std::vector<Direction> wi, wo;
  for (std::size_t k = 0; k < pairs; ++k) wi.push_back(direction(random)), wo.push_back(direction(random));
  std::vector<double> wanted(pairs * channels), got(pairs * read);
  back.brdf->eval(wi, wo, got);
  out.read_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  source.brdf->eval(wi, wo, wanted);
  std::vector<double> errors;
  for (std::size_t k = 0; k < pairs; ++k)
    for (std::size_t c = 0; c < read; ++c) {
      const double truth = wanted[k * channels + (channels == 1 ? 0 : c)], value = got[k * read + c];
      if (!(truth > 0) || std::isnan(value)) {
        ++out.n_left_out;
        continue;
      }
      errors.push_back(std::fabs(value - truth) / truth);
      out.mean += errors.back();
    }
  if (errors.empty()) return reason = "no direction is known to both", std::nullopt;
  std::sort(errors.begin(), errors.end());
  out.n = errors.size();
  out.mean /= static_cast<double>(out.n);
  out.p95 = errors[static_cast<std::size_t>(0.95 * static_cast<double>(out.n))];
  out.largest = errors.back();
  return out;
}

Json round_trip_document(const std::optional<RoundTrip>& result, const std::string& reason) {
  if (!result) return Json::object({{"reason", reason}});
  return Json::object({{"n", static_cast<std::int64_t>(result->n)},
                       {"n_left_out", static_cast<std::int64_t>(result->n_left_out)},
                       {"mean", result->mean},
                       {"p95", result->p95},
                       {"largest", result->largest},
                       {"read_ms", 1e3 * result->read_s}});
}

}  // namespace gonio::tools
