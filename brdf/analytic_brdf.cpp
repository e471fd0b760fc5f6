// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/analytic_brdf.hpp"

#include <utility>

#include "brdf/error.hpp"

namespace gonio {

AnalyticBrdf::AnalyticBrdf(std::string_view model, Channels channels, std::vector<std::vector<double>> values)
    : info_(&model_info(model)), channels_(std::move(channels)), values_(std::move(values)) {
  std::vector<Fault> faults;
  if (values_.size() != channels_.size())
    faults.push_back(
        {std::string(model), std::to_string(values_.size()) + " parameter sets", "one per channel, " + std::to_string(channels_.size())});
  for (const auto& set : values_) {
    if (set.size() != info_->parameters.size()) {
      faults.push_back({std::string(model), std::to_string(set.size()) + " parameters", std::to_string(info_->parameters.size())});
      continue;
    }
    for (std::size_t k = 0; k < set.size(); ++k) {
      const Parameter& p = info_->parameters[k];
      if (!(set[k] >= p.lower && set[k] <= p.upper))
        faults.push_back(
            {std::string(p.name), std::to_string(set[k]), "a number from " + std::to_string(p.lower) + " to " + std::to_string(p.upper)});
    }
  }
  if (!faults.empty()) throw Error(ErrorKind::usage, "the parameters of model '" + std::string(model) + "' are not usable", faults);
}

Symmetry AnalyticBrdf::symmetry() const { return {info_->properties.isotropic, info_->properties.bilateral, info_->properties.reciprocal}; }

void AnalyticBrdf::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  for (std::size_t k = 0; k < wi.size(); ++k) {
    const LobeGeometry g = lobe_geometry(wi[k], wo[k]);
    for (std::size_t c = 0; c < values_.size(); ++c) f[k * values_.size() + c] = info_->evaluate(g, values_[c].data());
  }
}

std::vector<double> AnalyticBrdf::eval(const GonioAngles& angles) const {
  std::vector<double> f(values_.size());
  const LobeGeometry g = lobe_geometry(angles);
  for (std::size_t c = 0; c < values_.size(); ++c) f[c] = info_->evaluate(g, values_[c].data());
  return f;
}

std::vector<double> AnalyticBrdf::directional_albedo(Angle theta_i, Angle phi_i) const {
  std::vector<double> out(values_.size()), each(info_->linear_count);
  for (std::size_t c = 0; c < values_.size(); ++c) {
    info_->albedo(theta_i, phi_i, values_[c].data() + info_->linear_count, each.data());
    for (std::size_t k = 0; k < each.size(); ++k) out[c] += values_[c][k] * each[k];
  }
  return out;
}

std::vector<double> AnalyticBrdf::albedo_bound() const {
  std::vector<double> out;
  for (const std::vector<double>& values : values_) out.push_back(info_->albedo_bound(values.data()));
  return out;
}

}  // namespace gonio
