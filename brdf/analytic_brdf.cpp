// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/analytic_brdf.hpp"

#include <cmath>
#include <utility>

#include "brdf/error.hpp"
#include "brdf/models.hpp"

namespace gonio {
namespace {

/// Calls `f` with the model of that name.
template <class F>
void with_model(std::string_view name, F&& f) {
  for_each_model([&](auto model) {
    if (decltype(model)::name == name) f(model);
  });
}

}  // namespace

const std::vector<ModelInfo>& model_infos() {
  static const std::vector<ModelInfo> infos = [] {
    std::vector<ModelInfo> out;
    for_each_model([&]<class M>(M) {
      out.push_back({M::name, M::citation, std::span<const Parameter>(M::parameters), linear_count<M>(), M::depends_on, M::properties});
    });
    return out;
  }();
  return infos;
}

const ModelInfo& model_info(std::string_view name) {
  std::string known;
  for (const ModelInfo& info : model_infos()) {
    if (info.name == name) return info;
    known += (known.empty() ? "" : ", ") + std::string(info.name);
  }
  throw Error(ErrorKind::usage, {"model", "'" + std::string(name) + "'", "one of " + known});
}

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
  with_model(info_->name, [&]<class M>(M) {
    for (std::size_t k = 0; k < wi.size(); ++k) {
      const LobeGeometry g = lobe_geometry(wi[k], wo[k]);
      for (std::size_t c = 0; c < values_.size(); ++c) f[k * values_.size() + c] = evaluate<M>(g, values_[c].data());
    }
  });
}

std::vector<double> AnalyticBrdf::eval(const GonioAngles& angles) const {
  std::vector<double> f(values_.size());
  with_model(info_->name, [&]<class M>(M) {
    const LobeGeometry g = lobe_geometry(angles);
    for (std::size_t c = 0; c < values_.size(); ++c) f[c] = evaluate<M>(g, values_[c].data());
  });
  return f;
}

std::vector<double> AnalyticBrdf::directional_albedo(Angle theta_i) const {
  std::vector<double> out(values_.size());
  with_model(info_->name, [&]<class M>(M) {
    for (std::size_t c = 0; c < values_.size(); ++c) {
      std::array<double, linear_count<M>()> albedo{};
      M::albedo(theta_i, values_[c].data() + linear_count<M>(), albedo.data());
      for (std::size_t k = 0; k < albedo.size(); ++k) out[c] += values_[c][k] * albedo[k];
    }
  });
  return out;
}

std::vector<double> AnalyticBrdf::albedo_bound() const {
  std::vector<double> out(values_.size());
  with_model(info_->name, [&]<class M>(M) {
    for (std::size_t c = 0; c < values_.size(); ++c) {
      std::array<double, linear_count<M>()> bound{};
      M::albedo_bound(values_[c].data() + linear_count<M>(), bound.data());
      for (std::size_t k = 0; k < bound.size(); ++k) out[c] += values_[c][k] * bound[k];
    }
  });
  return out;
}

}  // namespace gonio
