// SPDX-License-Identifier: BSD-3-Clause
// A BRDF on a product of four lists of angles.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/dataset.hpp"

namespace gonio::tabulated {

/// What the four angles of a lattice are.
enum class LatticeCoordinates {
  spherical,        ///< theta_i, phi_i, theta_o, phi_o; with a single phi_i the last is phi_o - phi_i
  specular,         ///< theta_i, phi_i, angle from the specular direction, azimuth about it (tabulated/specular_angles.hpp)
  half_difference,  ///< theta_h, phi_h, theta_d, phi_d of Rusinkiewicz (brdf/coordinates.hpp)
  distorted,  ///< theta_i, phi_i, polar angle, azimuth of tabulated/distorted_angles.hpp; with a single phi_i the last counts from phi_i
  beta        ///< theta_i, phi_i, length (no angle: `nodes_deg[2]` is in 0 ... 2) and azimuth of tabulated/beta_offset.hpp
};

struct Lattice {
  LatticeCoordinates coordinates = LatticeCoordinates::spherical;
  std::array<std::vector<double>, 4> nodes_deg;  ///< increasing, none empty; a single second angle: isotropic
  /// Specular and distorted coordinates only: what is added to theta_i to get the zenith angle the third angle counts from, per theta_i;
  /// or empty.
  std::vector<double> offset_deg;
  bool bilateral = false;   ///< the last angle stands for its negative too
  bool reciprocal = false;  ///< half-difference only: phi_d stands for phi_d + 180° too
  Side side = Side::reflection;

  std::size_t size() const noexcept;
  /// The first angle varies fastest.
  std::size_t index(const std::array<std::size_t, 4>& at) const noexcept;
  std::array<std::size_t, 4> position(std::size_t index) const noexcept;
  /// The pose of a node, in transmission with theta_o beyond 90°.
  GonioAngles angles(std::size_t index) const;
  /// Both directions are on their side of the surface.
  bool has_directions(const GonioAngles& node) const noexcept;
  Symmetry symmetry() const noexcept;

  friend bool operator==(const Lattice&, const Lattice&) = default;
};

/// More nodes than this are refused by readers: a sample of each is made.
constexpr std::size_t max_lattice_nodes = std::size_t{1} << 22;

/// Linear between the nodes in all four angles, constant beyond the first and last zenith angle, around the circle in azimuths that are not
/// folded. Nodes beyond the horizon, whatever number stands there, and unknown ones are left out and the weights of the others scaled up;
/// NaN where nothing is left. 0 below the horizon.
class LatticeTable final : public Brdf {
 public:
  /// `values[c][index]` in 1/sr, NaN where unknown. Throws Error(internal) if their number is not that of the lattice.
  LatticeTable(Lattice lattice, Channels channels, std::vector<std::vector<double>> values);

  const Lattice& lattice() const noexcept { return lattice_; }
  const std::vector<std::vector<double>>& values() const noexcept { return values_; }

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return lattice_.symmetry(); }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;

  /// The nodes on their side of the horizon as samples; the others and unknown ones are counted as masked. Where all azimuths are the same
  /// direction, equal values are one sample.
  Dataset samples() const;

 private:
  Lattice lattice_;
  Channels channels_;
  std::vector<std::vector<double>> values_;
  std::vector<bool> usable_;  ///< [index] both directions are there and no channel is NaN
};

}  // namespace gonio::tabulated
