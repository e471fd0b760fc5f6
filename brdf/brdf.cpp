// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/brdf.hpp"

namespace gonio {

std::vector<double> Brdf::eval(const Direction& wi, const Direction& wo) const {
  std::vector<double> f(channels().size());
  eval(std::span(&wi, 1), std::span(&wo, 1), f);
  return f;
}

}  // namespace gonio
