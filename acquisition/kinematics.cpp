// SPDX-License-Identifier: BSD-3-Clause
// The list of kinematics by name.
#include "acquisition/kinematics.hpp"

#include "acquisition/spherical_gantry.hpp"
#include "brdf/error.hpp"

namespace gonio::acquisition {

std::unique_ptr<Kinematics> make_kinematics(const Bench& bench) {
  if (bench.kinematics == "spherical-gantry") return std::make_unique<SphericalGantry>(bench);
  throw Error(ErrorKind::input, Fault{"/kinematics/type", bench.kinematics, "spherical-gantry"});
}

}  // namespace gonio::acquisition
