// SPDX-License-Identifier: BSD-3-Clause
// Klems' patches: a hemisphere cut into rings and the rings into sectors.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/direction.hpp"

namespace gonio::tabulated {

/// Between two zenith angles, cut into `patches` equal sectors; the first of them is centred on azimuth 0.
struct PatchRing {
  double lower_deg = 0, upper_deg = 0;
  std::size_t patches = 1;
  friend bool operator==(const PatchRing&, const PatchRing&) = default;
};

/// J. H. Klems, "A new method for predicting the solar heat gain of complex fenestration systems", ASHRAE Transactions 100(1), 1994, in
/// the numbering of WINDOW and Radiance: ring by ring from the normal, in a ring counter-clockwise from azimuth 0. Sector i of n is
/// centred on 360° i/n.
class KlemsBasis {
 public:
  /// Rings that follow each other from 0° on; trusts them.
  KlemsBasis(std::string name, std::vector<PatchRing> rings);

  static const KlemsBasis& full();     ///< 145 patches
  static const KlemsBasis& half();     ///< 77 patches
  static const KlemsBasis& quarter();  ///< 41 patches
  /// One of these three by its name in files (`LBNL/Klems Full`, in whatever case), or null.
  static const KlemsBasis* standard(std::string_view name);

  const std::string& name() const noexcept { return name_; }
  const std::vector<PatchRing>& rings() const noexcept { return rings_; }
  std::size_t size() const noexcept { return first_.back(); }  ///< number of patches

  /// The patch of a direction with z >= 0, or nothing beyond the last ring.
  std::optional<std::size_t> patch_of(double x, double y, double z) const noexcept;

  struct Patch {
    const PatchRing* ring;
    std::size_t ring_index;
    double centre_phi_deg, width_deg;  ///< of the sector
  };
  Patch patch(std::size_t index) const noexcept;
  /// The middle of the patch; the normal for a cap.
  Angle centre_theta(std::size_t index) const noexcept;
  Angle centre_phi(std::size_t index) const noexcept;
  /// ∫ cos theta d omega over the patch: pi (cos² lower - cos² upper) / n.
  double projected_solid_angle(std::size_t index) const noexcept;
  /// The patch at the opposite azimuth and at the negative one; nothing where the ring has an odd number of patches.
  std::optional<std::size_t> opposite(std::size_t index) const noexcept;
  std::size_t mirrored(std::size_t index) const noexcept;

 private:
  std::string name_;
  std::vector<PatchRing> rings_;
  std::vector<double> cos_upper_;   ///< of each ring
  std::vector<std::size_t> first_;  ///< patch of each ring, and the number of all
};

}  // namespace gonio::tabulated
