// SPDX-License-Identifier: BSD-3-Clause
// Tabulating a BRDF on MERL's grid.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "tabulated/merl.hpp"

namespace gonio::tabulated {
namespace {

constexpr double masked_value = -1;

/// Fills one theta_h row of the three planes.
class RowWriter {
 public:
  RowWriter(const Brdf& brdf, MerlNodes nodes, std::string& bytes)
      : brdf_(brdf), nodes_(nodes), bytes_(bytes), channel_count_(brdf.channels().size()) {}

  MerlWriteResult write(std::size_t row) {
    MerlWriteResult result;
    cells_.clear(), wi_.clear(), wo_.clear();
    for (std::size_t k = 0; k < MerlGrid::row_count; ++k) {
      const std::size_t cell = row * MerlGrid::row_count + k;
      const DirectionPair pair = directions(MerlGrid::node(MerlGrid::cell(cell), nodes_));
      if (!above_horizon(pair)) {
        mask(cell);
        ++result.below_horizon;
        continue;
      }
      cells_.push_back(cell), wi_.push_back(pair.wi), wo_.push_back(pair.wo);
    }
    f_.resize(cells_.size() * channel_count_);
    brdf_.eval(wi_, wo_, f_);
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const auto values = std::span<const double>(f_).subspan(k * channel_count_, channel_count_);
      const auto any = [&](auto&& predicate) { return std::any_of(values.begin(), values.end(), predicate); };
      if (any([](double value) { return std::isinf(value); }))
        throw Error(ErrorKind::input,
                    {"the BRDF to be tabulated", fmt::format("an infinite value at cell {}", cells_[k]), "finite values"});
      const bool unknown = any([](double value) { return std::isnan(value); });
      if (unknown || any([](double value) { return value < 0; })) {
        mask(cells_[k]);
        ++(unknown ? result.unknown : result.negative);
        continue;
      }
      for (std::size_t c = 0; c < 3; ++c) store(c, cells_[k], values[channel_count_ == 1 ? 0 : c] / MerlPlanes::file_scale[c]);
    }
    return result;
  }

 private:
  void mask(std::size_t cell) {
    for (std::size_t c = 0; c < 3; ++c) store(c, cell, masked_value);
  }
  void store(std::size_t plane, std::size_t cell, double value) {
    std::memcpy(bytes_.data() + merl_header_size + (plane * MerlGrid::cell_count + cell) * sizeof value, &value, sizeof value);
  }

  const Brdf& brdf_;
  MerlNodes nodes_;
  std::string& bytes_;
  std::size_t channel_count_;
  std::vector<std::size_t> cells_;
  std::vector<Direction> wi_, wo_;
  std::vector<double> f_;
};

/// Rows are handed out one by one; the first failure stops the others and comes back.
MerlWriteResult fill(const Brdf& brdf, MerlNodes nodes, int threads, std::string& bytes) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  MerlWriteResult total;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      RowWriter writer(brdf, nodes, bytes);
      for (std::size_t row = next++; row < MerlGrid::theta_h_count; row = next++) {
        const MerlWriteResult result = writer.write(row);
        const std::lock_guard lock(mutex);
        total.below_horizon += result.below_horizon;
        total.unknown += result.unknown;
        total.negative += result.negative;
      }
    } catch (...) {
      next = MerlGrid::theta_h_count;
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int k = 1; k < threads; ++k) helpers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return total;
}

Json sidecar(const MerlWriteResult& result, MerlNodes nodes, const std::string& source, bool simulated) {
  const auto& scale = MerlPlanes::file_scale;
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return Json::object({{"context", context({}, std::nullopt, simulated)},
                       {"format", "merl"},
                       {"node_rule", name(nodes)},
                       {"unit", "1/sr"},
                       {"cosine_included", false},
                       {"stored", "f / scale"},
                       {"scale", Json::object({{"r", scale[0]}, {"g", scale[1]}, {"b", scale[2]}})},
                       {"primaries", Json()},
                       {"primaries_note", "linear colour; the format does not define its primaries"},
                       {"source", source},
                       {"n_masked", Json::object({{"below_horizon", count(result.below_horizon)},
                                                  {"nan", count(result.unknown)},
                                                  {"negative", count(result.negative)}})}});
}

}  // namespace

MerlWriteResult write_merl(const Brdf& brdf, const std::filesystem::path& path, const WriteOptions& options, const std::string& source,
                           bool simulated) {
  const std::size_t channel_count = brdf.channels().size();
  if (channel_count != 1 && channel_count != 3)
    throw Error(ErrorKind::input,
                {path.string(), fmt::format("{} channels to be written", channel_count), "one channel, or three for r, g, b"});
  std::string bytes(merl_file_size, '\0');
  const std::int32_t dimensions[3] = {MerlGrid::theta_h_count, MerlGrid::theta_d_count, MerlGrid::phi_d_count};
  std::memcpy(bytes.data(), dimensions, sizeof dimensions);
  const MerlWriteResult result = fill(brdf, options.merl_nodes, std::max(1, options.threads), bytes);
  if (result.below_horizon + result.unknown + result.negative == MerlGrid::cell_count)
    throw Error(ErrorKind::input, {path.string(), "a BRDF that is known at no node of MERL's grid", "at least one value"});
  // The sidecar first: a table without one would be read with the default rule. If the table then fails, the old pair stays.
  const std::filesystem::path beside = merl_sidecar(path);
  std::error_code error;
  const std::optional<std::string> old_sidecar = std::filesystem::exists(beside, error) ? std::optional(read_file(beside)) : std::nullopt;
  write_file_atomically(beside, sidecar(result, options.merl_nodes, source, simulated).dump() + "\n");
  try {
    write_file_atomically(path, bytes);
  } catch (...) {
    if (old_sidecar)
      write_file_atomically(beside, *old_sidecar);
    else
      std::filesystem::remove(beside, error);
    throw;
  }
  return result;
}

}  // namespace gonio::tabulated
