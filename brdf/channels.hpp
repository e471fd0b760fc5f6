// SPDX-License-Identifier: BSD-3-Clause
// What one value of a sample means: its channel, and what holds for the data by construction.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gonio {

/// The quantity a file holds. Every reader turns it into f on entry.
enum class Quantity {
  f,                   ///< f_r = dL_o/dE_i [1/sr], cosine not included
  f_cos,               ///< f_r cos theta_o [1/sr]
  reflectance_factor,  ///< R = pi f_r [1]
  signal_ratio,        ///< reading relative to a white read at normal view [1]: f = RT / (pi cos theta_o)
};

const char* name(Quantity quantity) noexcept;
std::optional<Quantity> quantity_named(const std::string& text);

/// One channel of a data set or a model. Unknown is `nullopt`, never 0.
struct Channel {
  std::string name;  ///< `r`, `g`, `b`, `Y`, `550nm`, `value`, ...
  Quantity quantity = Quantity::f;
  std::optional<double> wavelength_in_nm, wavelength_out_nm, bandwidth_nm;
  std::optional<std::string> polarisation_in, polarisation_out;

  friend bool operator==(const Channel&, const Channel&) = default;
};

using Channels = std::vector<Channel>;

/// `r, g, b`: linear RGB, primaries undefined unless the file says more.
Channels rgb_channels();
Channels single_channel(std::string name);

/// What holds *by construction* of the data or the model. A check of a property flagged here is vacuous.
struct Symmetry {
  bool isotropic = false;   ///< depends on phi_o - phi_i only
  bool bilateral = false;   ///< f(phi) = f(-phi)
  bool reciprocal = false;  ///< f(wi, wo) = f(wo, wi)

  friend bool operator==(const Symmetry&, const Symmetry&) = default;
};

enum class Side { reflection, transmission };

}  // namespace gonio
