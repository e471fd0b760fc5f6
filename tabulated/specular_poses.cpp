// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/specular_poses.hpp"

#include "tabulated/radial_grid.hpp"
#include "tabulated/specular_angles.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {

std::vector<GonioAngles> specular_poses(const Opened& source, const WriteOptions& options) {
  const Symmetry symmetry = source.brdf->symmetry();
  const Side side = source.side;
  const double step = options.size == GridSize::paper ? 15 : options.size == GridSize::standard ? 10 : 5;
  const std::size_t count = options.size == GridSize::paper ? 32 : options.size == GridSize::standard ? 64 : 128;
  const std::vector<double> incidences = incidence_grid(options.size),
                            azimuths = even_angles(0, symmetry.bilateral ? 180 : 360 - step, step),
                            turns = symmetry.isotropic ? std::vector<double>{0} : even_angles(0, 330, 30),
                            radials = radial_grid(source, incidences, side, count, options.threads);
  std::vector<GonioAngles> out;
  for (const double incidence : incidences)
    for (const double turn : incidence == 0 ? std::vector<double>{0} : turns)
      for (const double radial : radials)
        for (const double azimuth : radial == 0 ? std::vector<double>{0} : azimuths) {
          const GonioAngles pose = from_specular(degrees(incidence), degrees(turn), {radial, azimuth}, side);
          if (side == Side::reflection ? pose.theta_o.degrees() < 90 : pose.theta_o.degrees() > 90) out.push_back(pose);
        }
  return out;
}

}  // namespace gonio::tabulated
