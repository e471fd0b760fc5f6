// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/rough_interface.hpp"

#include <algorithm>
#include <cmath>

#include "tabulated/targets/microfacet.hpp"

namespace gonio::tabulated::targets {
namespace {

constexpr double pi = std::numbers::pi;

/// Fresnel reflectance of an interface whose far side has `index` times the near side's; 1 under total reflection. `cos_t` is the cosine
/// on the far side.
double fresnel(double c, double index, double& cos_t) {
  const double sin2_t = (1 - c * c) / (index * index);
  if (sin2_t >= 1) return cos_t = 0, 1;
  cos_t = std::sqrt(1 - sin2_t);
  const double rs = (c - index * cos_t) / (c + index * cos_t), rp = (index * c - cos_t) / (index * c + cos_t);
  return (rs * rs + rp * rp) / 2;
}

double lambda(double cosine, double alpha) {
  const double c2 = cosine * cosine;
  return (std::sqrt(1 + alpha * alpha * (1 - c2) / c2) - 1) / 2;
}

struct Parts {
  double reflected = 0, transmitted = 0;
};

/// Mean over the normals visible from a direction of this cosine. They are, after the surface is stretched to alpha = 1, a cap of the
/// sphere about the direction: uniform in the height of the mirrored directions and in azimuth (J. Dupuy, A. Benyoub, Sampling Visible GGX
/// Normals with Spherical Caps, HPG 2023).
Parts parts(double cosine, double alpha, double index, RoughInterface::Shadowing shadowing) {
  constexpr int heights = 24, azimuths = 12;
  const double sine = std::sqrt(1 - cosine * cosine), length = std::hypot(alpha * sine, cosine);
  const double vx = alpha * sine / length, vz = cosine / length, own = lambda(cosine, alpha);
  Parts out;
  for (int a = 0; a < heights; ++a)
    for (int b = 0; b < azimuths; ++b) {
      const double z = (1 - (a + 0.5) / heights) * (1 + vz) - vz, r = std::sqrt(std::max(0.0, 1 - z * z));
      const double phi = pi * (b + 0.5) / azimuths;
      double mx = alpha * (r * std::cos(phi) + vx), my = alpha * r * std::sin(phi), mz = z + vz;
      const double norm = std::sqrt(mx * mx + my * my + mz * mz);
      mx /= norm, my /= norm, mz /= norm;
      const double c = sine * mx + cosine * mz;
      if (!(c > 0)) continue;
      double cos_t = 0;
      const double f = fresnel(c, index, cos_t);
      const auto weight = [&](double cos_other) {
        const double other = lambda(cos_other, alpha);
        return shadowing == RoughInterface::Shadowing::separable ? 1 / (1 + other) : (1 + own) / (1 + own + other);
      };
      if (const double up = 2 * c * mz - cosine; up > 0) out.reflected += f * weight(up);
      if (const double down = (c / index - cos_t) * mz - cosine / index; down < 0) out.transmitted += (1 - f) * weight(-down);
    }
  out.reflected /= heights * azimuths;
  out.transmitted /= heights * azimuths;
  return out;
}

}  // namespace

RoughInterface::RoughInterface(double alpha, double index, Shadowing shadowing, Mean mean) : inverse_index2_(1 / (index * index)) {
  constexpr double lowest = 1e-6;  // of the cosines: at 0 nothing is seen of the surface
  double sum = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    const double cosine = std::max(lowest, static_cast<double>(k) / (nodes - 1));
    transmittance_[k] = parts(cosine, alpha, index, shadowing).transmitted;
    const double value = 2 * cosine * parts(cosine, alpha, 1 / index, shadowing).reflected;
    const bool end = k == 0 || k + 1 == nodes;
    sum += mean == Mean::trapezoidal && end ? value / 2 : value;
  }
  internal_ = sum / static_cast<double>(mean == Mean::trapezoidal ? nodes - 1 : nodes);
}

double RoughInterface::transmittance(double cosine) const {
  const double at = std::clamp(cosine, 0.0, 1.0) * (nodes - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(at), nodes - 2);
  const double t = at - static_cast<double>(k);
  return (1 - t) * transmittance_[k] + t * transmittance_[k + 1];
}

double RoughInterface::diffuse(double albedo, double cos_i, double cos_o) const {
  return inverse_pi * inverse_index2_ * albedo / (1 - albedo * internal_) * transmittance(cos_i) * transmittance(cos_o);
}

}  // namespace gonio::tabulated::targets
