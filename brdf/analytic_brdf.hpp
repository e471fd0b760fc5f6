// SPDX-License-Identifier: BSD-3-Clause
// The analytic models by name, and one of them with numbers in it as a Brdf.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/model.hpp"

namespace gonio {

/// Everything about a model that does not need its type.
struct ModelInfo {
  std::string_view name, citation;
  std::span<const Parameter> parameters;  ///< linear first
  std::size_t linear_count;
  DependsOn depends_on;
  ModelProperties properties;
};

/// Every model of the list (brdf/models.hpp), in its order.
const std::vector<ModelInfo>& model_infos();
/// Throws Error(usage) with the known names if there is no such model.
const ModelInfo& model_info(std::string_view name);

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

  /// Directional albedo ∫ f cos theta_o dwo per channel, in closed form or by a geometrically convergent rule.
  std::vector<double> directional_albedo(Angle theta_i) const;
  /// The largest directional albedo over all incidences, per channel. Energy is conserved iff it is <= 1.
  std::vector<double> albedo_bound() const;

 private:
  const ModelInfo* info_;
  Channels channels_;
  std::vector<std::vector<double>> values_;
};

}  // namespace gonio
