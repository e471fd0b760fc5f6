// SPDX-License-Identifier: BSD-3-Clause
// Samples as the fitter and the checks read them: block by block, straight from where they are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "brdf/channels.hpp"
#include "brdf/dataset.hpp"
#include "brdf/lobe_geometry.hpp"

namespace gonio {

/// A column of numbers somewhere in memory: `scale · p[k · stride]` in units of the element.
/// The numbers need not be aligned: MERL's start 12 bytes into the file, so a pointer to double must never be dereferenced here
/// (compilers that vectorise such a loop may choose aligned loads). Read through this operator or copy with memcpy.
struct Column {
  enum class Type { f64, f32 };
  const void* data = nullptr;
  std::ptrdiff_t stride = 1;
  Type type = Type::f64;
  double scale = 1;

  explicit operator bool() const noexcept { return data != nullptr; }
  double operator[](std::size_t k) const noexcept {
    const auto offset = static_cast<std::ptrdiff_t>(k) * stride;
    const auto read = [&]<class T>(T value) {
      std::memcpy(&value, static_cast<const std::byte*>(data) + offset * static_cast<std::ptrdiff_t>(sizeof value), sizeof value);
      return scale * static_cast<double>(value);
    };
    return type == Type::f64 ? read(0.0) : read(0.0f);
  }
};

/// What is the same for every sample of a block.
enum class ConstantOver { nothing, theta_h, incidence };

/// At most `Observations::max_block` samples.
struct ObservationBlock {
  std::size_t size = 0;
  ConstantOver constant = ConstantOver::nothing;
  double log_cos_h = 0;               ///< of the whole block, if constant == theta_h
  std::vector<Column> f;              ///< one per channel, 1/sr; NaN where this channel has no value
  std::vector<Column> u;              ///< one per channel, 1/sr, or empty: unknown
  std::vector<Column> read_variance;  ///< one per channel, 1/sr²: the part of u² that does not grow with f; or empty: unknown
  /// Which samples count: all, those with mask[k] != 0, or (MERL) those where no channel is negative.
  enum class Validity { all, mask, no_channel_negative } validity = Validity::all;
  const std::uint8_t* mask = nullptr;

  bool valid(std::size_t k) const noexcept {
    if (validity == Validity::mask) return mask[k] != 0;
    if (validity == Validity::no_channel_negative)
      for (const Column& column : f)
        if (column[k] < 0) return false;
    return true;
  }
};

/// What microfacet lobes need of the samples of a block, in float because they are many; every cosine is rounded once.
struct FacetGeometry {
  std::vector<float> tan2_h;               ///< tan² theta_h; 0 where there is no half vector above the surface
  std::vector<float> cos_i, cos_o, cos_d;  ///< as in LobeGeometry
};

/// What a lobe about the mirror direction needs of the samples of a block.
struct MirrorGeometry {
  std::vector<double> sin2_half_psi;  ///< sin²(psi/2) = (1 - cos psi)/2 of LobeGeometry's psi; 0.5 or more where there is no lobe
  std::vector<double> cos_i, cos_o;   ///< as in LobeGeometry
};

/// Samples of a BRDF in blocks. No copy of a table is made: a block points into the mapping or the data set, which must outlive it.
/// Every member is safe to call from several threads.
class Observations {
 public:
  static constexpr std::size_t max_block = 16384;
  virtual ~Observations() = default;

  virtual const Channels& channels() const = 0;
  virtual Symmetry symmetry() const = 0;
  virtual std::size_t block_count() const = 0;
  virtual ObservationBlock block(std::size_t index) const = 0;
  /// The geometry of every sample of a block; `out` is resized. Costs time: ask only if the model needs it.
  virtual void geometry(std::size_t index, std::vector<LobeGeometry>& out) const = 0;
  /// The geometry of some samples of a block, by their numbers in it; `out` is resized. A table overrides this where a few samples cost
  /// less than all of them.
  virtual void geometry_of(std::size_t index, std::span<const std::size_t> samples, std::vector<LobeGeometry>& out) const;
  /// What microfacet lobes need of every sample of a block; `out` is resized. A table overrides this where its grid makes it cheap.
  virtual void facet_geometry(std::size_t index, FacetGeometry& out) const;
  /// What a lobe about the mirror direction needs of every sample of a block; `out` is resized. A table overrides this where its grid
  /// makes it cheap.
  virtual void mirror_geometry(std::size_t index, MirrorGeometry& out) const;
  /// The angles of every sample of a block; `out` is resized.
  virtual void angles(std::size_t index, std::vector<GonioAngles>& out) const = 0;
  /// Half-angles over which the samples of a block are means; unknown for data that do not say.
  virtual Apertures apertures(std::size_t) const { return {}; }
  /// Components of uncertainty shared by all samples.
  virtual std::vector<CorrelatedComponent> correlated() const { return {}; }
};

/// A data set as observations; shares ownership of it. The extra columns `var_read_<channel>`, or `var_read` for a single channel,
/// become the read variance.
std::unique_ptr<Observations> observe(std::shared_ptr<const Dataset> dataset);

}  // namespace gonio
