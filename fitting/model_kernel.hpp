// SPDX-License-Identifier: BSD-3-Clause
// The basis functions of a model over many samples, without its type.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "brdf/model_info.hpp"

namespace gonio::fitting {

/// At most this many linear parameters: small systems live on the stack.
inline constexpr std::size_t max_linear = 12;

/// f = Σ_k x_k basis_k(geometry; nonlinear). Samples below the horizon must have been left out: the horizon itself takes the model's
/// limit. For sums of models the terms stand one after the other, as in ModelInfo.
struct ModelKernel {
  const ModelInfo* info = nullptr;
  std::size_t linear = 0, nonlinear = 0;

  /// columns[k · stride + row] = basis_k.
  void basis(std::span<const LobeGeometry> geometry, const double* nonlinear_values, double* columns, std::size_t stride) const {
    info->basis(geometry, nonlinear_values, columns, stride);
  }
  /// The same, and slopes[(j · linear + k) · stride + row] = d basis_k / d nonlinear_j by automatic differentiation in the nonlinear
  /// parameters alone.
  void basis_and_slopes(std::span<const LobeGeometry> geometry, const double* nonlinear_values, double* columns, double* slopes,
                        std::size_t stride) const;
};

/// Throws Error(usage) if there is no such model or if it has more than `max_linear` linear parameters.
ModelKernel model_kernel(std::string_view model);

}  // namespace gonio::fitting
