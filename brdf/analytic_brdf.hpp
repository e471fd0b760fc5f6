// SPDX-License-Identifier: BSD-3-Clause
// An analytic model with numbers in it, as a Brdf.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/model_info.hpp"

namespace gonio {

/// A model with its parameter values. `values[c]` are the parameters of channel c in table order; a shared parameter is repeated.
class AnalyticBrdf final : public Brdf {
 public:
  /// Throws Error(usage) for an unknown model, a wrong number of parameters, a NaN or a value outside the parameter's bounds.
  AnalyticBrdf(std::string_view model, Channels channels, std::vector<std::vector<double>> values);

  const ModelInfo& model() const { return *info_; }
  const std::vector<std::vector<double>>& values() const { return values_; }

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override;
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;
  /// From angles: the form that keeps every digit at grazing.
  std::vector<double> eval(const GonioAngles& angles) const;

  /// Directional albedo ∫ f cos theta_o dwo per channel (ModelInfo::albedo); the azimuth matters to anisotropic models only.
  std::vector<double> directional_albedo(Angle theta_i, Angle phi_i = radians(0)) const;
  /// The largest directional albedo over all incidences, per channel (ModelInfo::albedo_bound). Energy is conserved iff it is <= 1.
  std::vector<double> albedo_bound() const;

 private:
  const ModelInfo* info_;
  Channels channels_;
  std::vector<std::vector<double>> values_;
};

}  // namespace gonio
