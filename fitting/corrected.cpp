// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/corrected.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace gonio::fitting {
namespace {

/// exp(Σ c · value) of every sample; empty where no component was estimated.
std::vector<double> factors(const Observations& all, std::span<const NuisanceParameter> nuisance) {
  std::vector<double> out;
  for (const CorrelatedComponent& component : all.correlated())
    for (const NuisanceParameter& p : nuisance) {
      if (!p.prior || p.name != component.name) continue;
      std::size_t samples = component.sensitivity.size();
      if (samples == 0)
        for (std::size_t b = 0; b < all.block_count(); ++b) samples += all.block(b).size;
      out.resize(samples, 1.0);
      for (std::size_t k = 0; k < samples; ++k)
        out[k] *= std::exp(p.value * (component.sensitivity.empty() ? 1 : component.sensitivity[k]));
    }
  return out;
}

class Corrected final : public Observations {
 public:
  Corrected(const Observations& all, std::span<const NuisanceParameter> nuisance) : all_(all), misalignment_(misalignment_of(nuisance)) {
    const std::vector<double> factor = factors(all, nuisance);
    if (factor.empty()) return;
    for (std::size_t b = 0, first = 0; b < all.block_count(); ++b) {
      const ObservationBlock block = all.block(b);
      Columns own;
      const auto divide = [&](const std::vector<Column>& from, std::vector<std::vector<double>>& to, double power) {
        for (const Column& column : from) {
          auto& values = to.emplace_back(block.size);
          for (std::size_t k = 0; k < block.size; ++k) values[k] = column[k] / std::pow(factor[first + k], power);
        }
      };
      divide(block.f, own.f, 1);
      divide(block.u, own.u, 1);
      divide(block.read_variance, own.read_variance, 2);
      columns_.push_back(std::move(own));
      first += block.size;
    }
  }

  const Channels& channels() const override { return all_.channels(); }
  Symmetry symmetry() const override { return all_.symmetry(); }
  std::size_t block_count() const override { return all_.block_count(); }
  ObservationBlock block(std::size_t index) const override {
    ObservationBlock out = all_.block(index);
    if (!misalignment_.none()) out.constant = ConstantOver::nothing;
    if (columns_.empty()) return out;
    const auto show = [](const std::vector<std::vector<double>>& from, std::vector<Column>& to) {
      for (std::size_t c = 0; c < from.size(); ++c) to[c] = {from[c].data(), 1, Column::Type::f64, 1};
    };
    show(columns_[index].f, out.f);
    show(columns_[index].u, out.u);
    show(columns_[index].read_variance, out.read_variance);
    return out;
  }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override {
    if (misalignment_.none()) return all_.geometry(index, out);
    std::vector<GonioAngles> nominal;
    all_.angles(index, nominal);
    out.clear();
    for (const GonioAngles& a : nominal) out.push_back(lobe_geometry(a, misalignment_));
  }
  void angles(std::size_t index, std::vector<GonioAngles>& out) const override {
    all_.angles(index, out);
    if (misalignment_.none()) return;
    for (GonioAngles& a : out) a = seen_by(misalignment_, a);
  }
  Apertures apertures(std::size_t index) const override { return all_.apertures(index); }
  std::vector<CorrelatedComponent> correlated() const override { return all_.correlated(); }

 private:
  struct Columns {
    std::vector<std::vector<double>> f, u, read_variance;  ///< [channel][sample of the block]
  };
  const Observations& all_;
  Misalignment misalignment_;
  std::vector<Columns> columns_;  ///< of every block; empty where the values stay as they are
};

}  // namespace

Misalignment misalignment_of(std::span<const NuisanceParameter> nuisance) {
  Misalignment out;
  for (const NuisanceParameter& p : nuisance)
    for (std::size_t k = 0; k < Misalignment::size; ++k)
      if (!p.prior && p.name == Misalignment::names[k]) out[k] = p.value * std::numbers::pi / 180;
  return out;
}

std::unique_ptr<Observations> corrected(const Observations& all, std::span<const NuisanceParameter> nuisance) {
  return std::make_unique<Corrected>(all, nuisance);
}

}  // namespace gonio::fitting
