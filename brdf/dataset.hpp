// SPDX-License-Identifier: BSD-3-Clause
// Measured samples with their uncertainty, column by column.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "brdf/channels.hpp"
#include "brdf/coordinates.hpp"

namespace gonio {

/// A named component of uncertainty that samples share (scale, certificate, drift, tilt, ...), k = 1.
/// A sample's part of it is f · sensitivity · u; sensitivities are d ln f / d name, 1 for every sample when empty.
struct CorrelatedComponent {
  std::string name;
  double u = 0;                     ///< standard uncertainty of the quantity; relative for a scale
  std::vector<double> sensitivity;  ///< one per sample (column `c_<name>`), or empty for 1
};

/// How many rows of a source did not become samples, and why.
struct MaskedCounts {
  std::size_t nan = 0, missing = 0, below_horizon = 0, blocked = 0;
  std::size_t total() const noexcept { return nan + missing + below_horizon + blocked; }
};

/// Half-angles and sizes over which every sample is a mean. Unknown is nullopt; 0 means ideal and must be said.
struct Apertures {
  std::optional<double> source_half_angle_deg, receiver_half_angle_deg, spot_diameter_m, field_diameter_m;
};

/// Samples of a BRDF: columns of equal length. Whatever a file held has become f [1/sr], **cosine not included**.
/// `u` is the independent standard uncertainty (k = 1) in 1/sr; NaN means unknown, 0 never occurs.
/// u_total² = u² + f² Σ (sensitivity · u(name))² over the correlated components.
struct Dataset {
  Channels channels;
  Symmetry symmetry;
  Side side = Side::reflection;
  Apertures apertures;

  std::vector<GonioAngles> angles;     ///< what the sample is a sample of: the read-back pose where there is one
  std::vector<std::vector<double>> f;  ///< [channel][sample] 1/sr; NaN where this channel has no value
  std::vector<std::vector<double>> u;  ///< [channel][sample] 1/sr, or empty: unknown throughout

  std::vector<CorrelatedComponent> correlated;
  /// Optional columns kept as they came: `repeat`, `n`, `time_s`, `range`, `x_mm`, `y_mm`, `measured_theta_i_deg`, `var_read`, ...
  std::map<std::string, std::vector<double>> extra;

  MaskedCounts masked;
  std::map<std::string, std::string> provenance;  ///< text pairs: source file and its sha256, program, instrument, sample
  bool simulated = false;

  std::size_t size() const noexcept { return angles.size(); }
  bool has_uncertainty() const noexcept { return !u.empty(); }
  /// Standard uncertainty of one sample with every correlated component added in squares; NaN if u is unknown.
  double total_uncertainty(std::size_t channel, std::size_t sample) const;
  /// Throws Error(internal) if columns differ in length or a u is 0 or negative.
  void require_consistent() const;
};

}  // namespace gonio
