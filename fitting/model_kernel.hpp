// SPDX-License-Identifier: BSD-3-Clause
// The basis functions of a model over many samples, without its type.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "brdf/analytic_brdf.hpp"

namespace gonio::fitting {

/// At most this many linear parameters: small systems live on the stack.
inline constexpr std::size_t max_linear = 6;

/// f = Σ_k x_k basis_k(geometry; s). Samples below the horizon must have been left out: the horizon itself takes the model's limit.
struct ModelKernel {
  const ModelInfo* info = nullptr;
  std::size_t linear = 0;
  bool has_exponent = false;  ///< one nonlinear parameter, or none

  /// columns[k · stride + row] = basis_k.
  void (*basis)(std::span<const LobeGeometry> geometry, double s, double* columns, std::size_t stride) = nullptr;
  /// The same, and slopes[k · stride + row] = d basis_k / d s by automatic differentiation in s alone.
  void (*basis_and_slope)(std::span<const LobeGeometry> geometry, double s, double* columns, double* slopes, std::size_t stride) = nullptr;
  /// The albedo bound of each basis function.
  void (*albedo_bound)(double s, double* out) = nullptr;
};

/// Throws Error(usage) if there is no such model.
ModelKernel model_kernel(std::string_view model);

}  // namespace gonio::fitting
