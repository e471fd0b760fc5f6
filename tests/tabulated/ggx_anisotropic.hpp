// SPDX-License-Identifier: BSD-3-Clause
// An anisotropic surface with narrow lobes, for tests of writers.
#pragma once

#include <cmath>
#include <numbers>

#include "brdf/brdf.hpp"

namespace gonio::test {

/// GGX with two roughnesses along x and y, height-correlated shadowing (Heitz, JCGT 3(2), 2014) and no Fresnel term; one channel.
class GgxAnisotropic final : public Brdf {
 public:
  GgxAnisotropic(double alpha_x, double alpha_y) : x_(alpha_x), y_(alpha_y) {}

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {.isotropic = false, .bilateral = false, .reciprocal = true}; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override {
    for (std::size_t k = 0; k < wi.size(); ++k) {
      const Direction &i = wi[k], &o = wo[k];
      f[k] = 0;
      if (!(i.z() > 0 && o.z() > 0)) continue;
      const Direction h = Direction::normalized(i.x() + o.x(), i.y() + o.y(), i.z() + o.z());
      const double e = std::pow(h.x() / x_, 2) + std::pow(h.y() / y_, 2) + h.z() * h.z();
      f[k] = 1 / (std::numbers::pi * x_ * y_ * e * e * (1 + lambda(i) + lambda(o)) * 4 * i.z() * o.z());
    }
  }

 private:
  double lambda(const Direction& w) const {
    return (std::sqrt(1 + (std::pow(x_ * w.x(), 2) + std::pow(y_ * w.y(), 2)) / (w.z() * w.z())) - 1) / 2;
  }

  double x_, y_;
  Channels channels_ = single_channel("value");
};

}  // namespace gonio::test
