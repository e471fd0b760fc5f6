// SPDX-License-Identifier: BSD-3-Clause
// A BRDF on a grid of angles about the specular direction.
#pragma once

#include <cstddef>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/dataset.hpp"
#include "tabulated/specular_angles.hpp"

namespace gonio::tabulated {

/// Sense in which the sample rotation of a table turns the azimuth of the light over the sample.
enum class RotationSense { counter_clockwise, clockwise };

/// Azimuth of the light at sample rotation 0: the format's rotation is the angle of the normal of the plane of incidence from the
/// sample's x axis, so at 0 that plane holds the y axis; the light comes from -y.
constexpr double phi_i_at_rotation_0_deg = 270;

struct SpecularGrid {
  std::vector<double> rotation_deg, incidence_deg, azimuth_deg, radial_deg;  ///< each increasing
  bool mirrored = false;  ///< azimuths 0 … 180° stand for both sides of the plane of incidence
  RotationSense sense = RotationSense::counter_clockwise;
  Side side = Side::reflection;

  std::size_t size() const noexcept { return rotation_deg.size() * incidence_deg.size() * azimuth_deg.size() * radial_deg.size(); }
  std::size_t index(std::size_t rotation, std::size_t incidence, std::size_t azimuth, std::size_t radial) const noexcept {
    return ((rotation * incidence_deg.size() + incidence) * azimuth_deg.size() + azimuth) * radial_deg.size() + radial;
  }
  /// Pose of a node; one rotation alone means that the sample has no orientation: then phi_i is 0.
  GonioAngles angles(std::size_t rotation, std::size_t incidence, std::size_t azimuth, std::size_t radial) const;
  bool beyond_horizon(const GonioAngles& node) const noexcept;

  friend bool operator==(const SpecularGrid&, const SpecularGrid&) = default;
};

/// Linear between nodes in rotation, incidence, azimuth and radial angle, so that a peak stays at the specular direction whatever the
/// incidence. Nodes beyond the horizon are left out of the interpolation (a table holds 0 or anything there). NaN outside the angles of
/// the table, 0 below the horizon.
class SpecularTable : public Brdf {
 public:
  /// `values[c]` are the nodes of channel c in the order of `SpecularGrid::index`, as the file has them. Throws Error(internal) if their
  /// number is not that of the grid.
  SpecularTable(SpecularGrid grid, Channels channels, std::vector<std::vector<double>> values);

  const SpecularGrid& grid() const noexcept { return grid_; }
  const std::vector<std::vector<double>>& values() const noexcept { return values_; }

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override;
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;

  /// The nodes this side of the horizon as samples, those beyond counted as masked. Equal values at radial 0, where all azimuths are the
  /// same direction, are one sample.
  Dataset samples() const;

 private:
  SpecularGrid grid_;
  Channels channels_;
  std::vector<std::vector<double>> values_;
  std::vector<bool> beyond_;  ///< [(incidence · azimuths + azimuth) · radials + radial]
};

}  // namespace gonio::tabulated
