// SPDX-License-Identifier: BSD-3-Clause
// The analytic models by name, sums of them included, without their types.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/model.hpp"

namespace gonio {

struct ModelInfo;

/// A model of the list as one term of a model: which of the whole model's parameters are its own.
struct ModelTerm {
  const ModelInfo* model = nullptr;  ///< of the list; a model of the list is its own only term
  std::size_t first_basis = 0;       ///< 0 for the first term; 1 for the others, which leave their diffuse part out
  std::size_t linear = 0;            ///< place of its first basis function that counts among the linear parameters
  std::size_t nonlinear = 0;         ///< place of its first nonlinear parameter among the nonlinear ones
};

/// Everything about a model, or a sum of models, that does not need its type.
///
/// A sum is written `a+b+…`. Its diffuse part is that of the first term; the other terms add their lobes. Parameters: `rho_d` and the
/// linear ones of every term in order, then the nonlinear ones of every term in order; a name met before gets `_2`, `_3`, … .
struct ModelInfo {
  std::string name, citation;
  std::vector<Parameter> parameters;  ///< linear first
  std::size_t linear_count = 0;
  DependsOn depends_on = DependsOn::all;
  ModelProperties properties{};
  bool closed_albedo = false;             ///< of every term, and largest at the normal
  PeakName peak{"lobe peak", "1/sr", 1};  ///< of a model of the list; of a sum look at its terms
  std::vector<ModelTerm> terms;

  std::size_t nonlinear_count() const noexcept { return parameters.size() - linear_count; }

  /// columns[k · stride + row] = basis_k of every pair of directions [1/sr]. The horizon itself takes the model's limit; what lies below
  /// it is the caller's to leave out.
  void basis(std::span<const LobeGeometry> geometry, const double* nonlinear, double* columns, std::size_t stride) const;
  /// f [1/sr] for parameters in table order; 0 below the horizon.
  double evaluate(const LobeGeometry& geometry, const double* parameters) const;
  /// Directional albedo of every basis function at an incidence: in closed form, or by quadrature where a term has none
  /// (brdf/numeric_albedo.hpp).
  void albedo(Angle theta_i, Angle phi_i, const double* nonlinear, double* out) const;
  /// The incidence with the largest directional albedo Σ linear_k · albedo_k: the normal where every term has a closed form, else the
  /// largest on a grid of zenith angles up to 89° (and of azimuths, if the model is anisotropic).
  struct Incidence {
    Angle theta, phi;
  };
  Incidence brightest_incidence(const double* parameters) const;
  /// The largest directional albedo over all incidences: the exact supremum where every term has a closed form, else the albedo at
  /// `brightest_incidence`.
  double albedo_bound(const double* parameters) const;
};

/// Every model of the list (brdf/models.hpp), in its order; sums are not listed.
const std::vector<ModelInfo>& model_infos();
/// The model or sum of that name; the reference stays valid. Throws Error(usage) with the known names if there is no such model, or if a
/// term after the first has no lobe to add. Safe to call from several threads.
const ModelInfo& model_info(std::string_view name);
/// Whether `name` is a model of the list or a sum of such.
bool is_model(std::string_view name);

}  // namespace gonio
