// SPDX-License-Identifier: BSD-3-Clause
// The samples that the values of a place rest on, found once for all places of a small box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "brdf/uncertain_brdf.hpp"
#include "tabulated/guided_samples.hpp"
#include "tabulated/kriging.hpp"

namespace gonio::tabulated {

/// Samples around a box of places, with all that does not depend on the place in the box: the factored kriging of the nearest samples that
/// do not hide behind each other, and what tells how a value came about.
class Neighbourhood {
 public:
  /// `half` edges of the box; all 0: one place alone.
  Neighbourhood(const GuidedSamples& samples, const CorrelationRanges& ranges, const PairPoint& centre, const PairPoint& half);

  /// More samples lie in the box than may take part: values there are to be found place by place.
  bool crowded() const noexcept { return crowded_; }
  /// Numbers of the samples' places, nearest to the centre first.
  const std::vector<std::size_t>& places() const noexcept { return places_; }
  /// The sample of `places` nearest to `at`.
  struct Nearest {
    std::size_t index = 0;  ///< in `places`
    double squared = 0;     ///< squared distance [steps²]
    bool is_here = false;   ///< the sample lies at `at` itself
  };
  Nearest nearest(const PairPoint& at) const noexcept;
  /// How a value at `at`, where no sample lies, comes about: extrapolated are places beyond the convex hull of the neighbours, those
  /// nearer to a masked direction than to a sample, and those farther from every sample than samples there are from each other.
  Coverage coverage(const PairPoint& at, const Nearest& nearest) const noexcept;
  void weights_at(const PairPoint& at, KrigingWeights& out) const { system_.weights_at(at, out); }

 private:
  void find_edges(const GuidedSamples& samples, const PairPoint& centre, const PairPoint& half);

  bool crowded_ = false, far_ = false, inside_ = false;
  std::vector<std::size_t> places_;
  std::vector<PairPoint> points_, wider_, masked_;
  std::vector<double> own_step_;  ///< [place] how far samples are from each other there; empty where there are no gaps
  KrigingSystem system_;
};

/// The neighbourhoods of the boxes of a lattice, made when first asked for and kept as long as there is room. What is handed out depends on
/// the box alone: not on the order of asking, nor on threads. Safe from several threads.
class Neighbourhoods {
 public:
  using Box = std::array<std::int64_t, 4>;

  /// Both must outlive this.
  Neighbourhoods(const GuidedSamples& samples, const CorrelationRanges& ranges);

  static Box box_of(const PairPoint& at) noexcept;
  std::shared_ptr<const Neighbourhood> of(const Box& box) const;
  Neighbourhood at(const PairPoint& place) const { return {samples_, ranges_, place, {}}; }

 private:
  /// Boxes that have the same hash; the oldest makes room for a new one.
  struct Bucket {
    static constexpr std::size_t ways = 4;
    std::array<Box, ways> boxes{};
    std::array<std::shared_ptr<const Neighbourhood>, ways> kept;
    std::size_t next = 0;
  };
  static constexpr std::size_t bucket_count = 8192;  // 32 768 boxes of some 4 KB
  static constexpr std::size_t mutex_count = 64;

  const GuidedSamples& samples_;
  CorrelationRanges ranges_;
  mutable std::vector<Bucket> buckets_;
  mutable std::array<std::mutex, mutex_count> mutexes_;
};

}  // namespace gonio::tabulated
