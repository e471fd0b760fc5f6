// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/direction.hpp"

#include "brdf/error.hpp"

namespace gonio {

template <class Frame>
UnitVector<Frame> UnitVector<Frame>::normalized(double x, double y, double z) {
  // Scale by the largest component first, so that neither 1e-200 nor 1e200 under- or overflows.
  const double scale = std::fmax(std::fabs(x), std::fmax(std::fabs(y), std::fabs(z)));
  if (!(scale > 0) || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
    throw Error(ErrorKind::input, {"direction", "a vector of zero or unknown length", "a finite vector that is not zero"});
  x /= scale, y /= scale, z /= scale;
  const double length = std::hypot(x, y, z);
  return trusted(x / length, y / length, z / length);
}

template class UnitVector<SampleFrame>;
template class UnitVector<BenchFrame>;

}  // namespace gonio
