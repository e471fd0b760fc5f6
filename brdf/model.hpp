// SPDX-License-Identifier: BSD-3-Clause
// What an analytic model is: a concept, a parameter table, and nothing the fitter would have to know twice.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>

#include "brdf/lobe_geometry.hpp"

namespace gonio {

/// One parameter of a model. Linear parameters multiply a basis function, are >= 0 and are fitted per channel; nonlinear ones are
/// shared by all channels unless told otherwise and are scanned, on a logarithmic or a linear axis.
struct Parameter {
  enum class Axis { logarithmic, linear };

  std::string_view name;
  std::string_view unit;
  double lower, upper;  ///< what the model is defined for
  bool linear;
  double scan_low = 0, scan_high = 0;  ///< where the global scan of a nonlinear parameter looks
  Axis axis = Axis::logarithmic;       ///< of the scan and of the intervals
  double example = 0.3;                ///< a value met in practice: for tests over the list, demos and help
  bool held = false;                   ///< a fit leaves it at its example unless it is given a value or bounds: data hardly determine it
};

/// The geometry a model depends on apart from the horizon: what lets the fitter collapse data without loss.
enum class DependsOn { nothing, theta_h, psi, all };

struct ModelProperties {
  bool reciprocal;      ///< f(wi, wo) = f(wo, wi) exactly
  bool isotropic;       ///< depends on phi_o - phi_i only
  bool bilateral;       ///< symmetric under phi_o - phi_i -> phi_i - phi_o: mirrored at every plane of incidence
  bool bounded = true;  ///< the directional albedo stays finite up to grazing incidence
};

/// What a lobe's value in its peak, at normal incidence, is called in the model's own parameters: data that see nothing but the peak
/// determine this and no parameter. expression = scale · (the lobe's value there in 1/sr).
struct PeakName {
  std::string_view expression, unit;
  double scale;
};

/// An analytic BRDF model: f = Σ_k linear_k · basis_k(geometry; nonlinear), in 1/sr, cosine not included.
///
/// `parameters` lists the linear parameters first, in the order of the basis; the first is always `rho_d` and its basis function the
/// diffuse part (1/π unless the model is one of diffuse reflection), so that sums of models share it. `basis<T>` takes the geometry in
/// double and the nonlinear parameters in T (double or an automatic-differentiation type).
///
/// Optional: `albedo(theta, nonlinear, out)`, the directional albedo of each basis function in closed form, and where its supremum over
/// all incidences is reached at the normal by every basis function also `albedo_bound(nonlinear, out)`, that supremum, so that energy is
/// conserved iff Σ linear_k · bound_k <= 1. Models without them are integrated numerically. Also optional: `peak`, a PeakName.
template <class M>
concept AnalyticModel = requires(const LobeGeometry& g, const double* nonlinear, double* out) {
  { M::name } -> std::convertible_to<std::string_view>;
  { M::citation } -> std::convertible_to<std::string_view>;
  { M::parameters.size() } -> std::convertible_to<std::size_t>;
  { M::depends_on } -> std::convertible_to<DependsOn>;
  { M::properties } -> std::convertible_to<ModelProperties>;
  M::basis(g, nonlinear, out);
  requires M::parameters[0].name == "rho_d" && M::parameters[0].linear;
};

/// A model that knows its directional albedo in closed form, largest at the normal.
template <class M>
concept ClosedAlbedo = AnalyticModel<M> && requires(const double* nonlinear, double* out, Angle theta) {
  M::albedo(theta, nonlinear, out);
  M::albedo_bound(nonlinear, out);
};

template <AnalyticModel M>
constexpr std::size_t linear_count() {
  std::size_t count = 0;
  for (const Parameter& parameter : M::parameters) count += parameter.linear ? 1 : 0;
  return count;
}
template <AnalyticModel M>
constexpr std::size_t nonlinear_count() {
  return M::parameters.size() - linear_count<M>();
}

/// f for parameters in table order (linear first); 0 below the horizon.
template <AnalyticModel M, class T>
T evaluate(const LobeGeometry& g, const T* parameters) {
  T basis[linear_count<M>()];
  T f(0.0);
  if (!g.above_horizon()) return f;
  M::basis(g, parameters + linear_count<M>(), basis);
  for (std::size_t k = 0; k < linear_count<M>(); ++k) f += parameters[k] * basis[k];
  return f;
}

/// cos^s from its logarithm, exp(s · log_cos): 0 where there is no lobe (at s = 0 too) and below e^-700.
template <class T>
T cosine_power(double log_cos, const T& s) {
  using std::exp;
  if (!(log_cos > LobeGeometry::no_lobe)) return T(0.0);
  const T exponent = s * log_cos;
  if (exponent < -700.0) return T(0.0);
  return exp(exponent);
}

}  // namespace gonio
