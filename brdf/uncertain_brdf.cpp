// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/uncertain_brdf.hpp"

namespace gonio {

const char* name(Coverage coverage) noexcept {
  switch (coverage) {
    case Coverage::measured: return "measured";
    case Coverage::interpolated: return "interpolated";
    case Coverage::extrapolated: return "extrapolated";
    case Coverage::unknown: return "unknown";
  }
  return "unknown";
}

}  // namespace gonio
