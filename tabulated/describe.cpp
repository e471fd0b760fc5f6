// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace gonio::tabulated {
namespace {

std::string covered(const Dataset& dataset, Angle GonioAngles::*angle) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const GonioAngles& angles : dataset.angles) {
    low = std::min(low, (angles.*angle).degrees());
    high = std::max(high, (angles.*angle).degrees());
  }
  return low == high ? fmt::format("{:.6g} deg", low) : fmt::format("{:.6g} to {:.6g} deg", low, high);
}

std::string words(const CorrelatedComponent& component) { return fmt::format("{} u = {:.3g}", component.name, component.u); }

}  // namespace

std::string joined_names(const Channels& channels) {
  std::string out;
  for (const Channel& channel : channels) out += (out.empty() ? "" : ", ") + channel.name;
  return out;
}

std::string words(const Symmetry& symmetry) {
  std::string out;
  const auto add = [&](bool holds, const char* word) {
    if (holds) out += (out.empty() ? "" : ", ") + std::string(word);
  };
  add(symmetry.isotropic, "isotropic");
  add(symmetry.bilateral, "bilateral");
  add(symmetry.reciprocal, "reciprocal");
  return out.empty() ? "none by construction" : out + " by construction";
}

Description describe(const Dataset& dataset) {
  Description out;
  out.emplace_back("samples", std::to_string(dataset.size()));
  out.emplace_back("channels", joined_names(dataset.channels));
  out.emplace_back("side", dataset.side == Side::transmission ? "transmission" : "reflection");
  if (dataset.size() > 0) {
    out.emplace_back("theta_i", covered(dataset, &GonioAngles::theta_i));
    out.emplace_back("phi_i", covered(dataset, &GonioAngles::phi_i));
    out.emplace_back("theta_o", covered(dataset, &GonioAngles::theta_o));
    out.emplace_back("phi_o", covered(dataset, &GonioAngles::phi_o));
  }
  out.emplace_back("uncertainty", dataset.has_uncertainty() ? "per sample" : "unknown");
  std::string components;
  for (const CorrelatedComponent& component : dataset.correlated) components += (components.empty() ? "" : ", ") + words(component);
  if (!components.empty()) out.emplace_back("correlated components", components);
  out.emplace_back("masked", fmt::format("{} ({} nan, {} missing, {} below horizon, {} blocked)", dataset.masked.total(),
                                         dataset.masked.nan, dataset.masked.missing, dataset.masked.below_horizon, dataset.masked.blocked));
  out.emplace_back("symmetry", words(dataset.symmetry));
  out.emplace_back("simulated", dataset.simulated ? "yes" : "no");
  for (const auto& [key, value] : dataset.provenance) out.emplace_back(key, value);
  return out;
}

}  // namespace gonio::tabulated
