// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/values_to_write.hpp"

#include "tabulated/opened_samples.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

Dataset product(std::initializer_list<double> theta_o, std::initializer_list<double> phi) {
  Dataset out;
  out.channels = single_channel("value");
  out.symmetry.isotropic = true;
  out.f.resize(1);
  for (const double theta_i : {0.0, 30.0})
    for (const double theta : theta_o)
      for (const double azimuth : phi) {
        if (theta == 0 && azimuth != *phi.begin()) continue;
        out.angles.push_back({degrees(theta_i), 90_deg, degrees(theta), degrees(azimuth + 90)});
        out.f[0].push_back(1);
      }
  return out;
}

}  // namespace

TEST_CASE("Samples that are a product of angles are known as one, whatever the azimuth of the light; with a gap they are none") {
  const Dataset samples = product({0, 20, 40}, {0, 90, 180, 270});
  const auto grid = grid_of_samples(samples);
  REQUIRE(grid);
  CHECK(grid->theta_o_deg == std::vector<double>{0, 20, 40});
  CHECK(grid->phi_deg == std::vector<double>{0, 90, 180, 270});
  Dataset gap = samples;
  gap.angles.pop_back(), gap.f[0].pop_back();
  CHECK_FALSE(grid_of_samples(gap));
  Dataset twice = samples;
  twice.angles.back() = twice.angles.front();
  CHECK_FALSE(grid_of_samples(twice));
  CHECK_FALSE(grid_of_samples(Dataset()));
}

TEST_CASE("Values come out per channel of the file, negative ones kept, with what the map changes") {
  Dataset samples = product({0, 20}, {0, 180});
  samples.channels = rgb_channels();
  samples.f = {samples.f[0], std::vector<double>(samples.size(), 2.0), std::vector<double>(samples.size(), -3.0)};
  const Opened source = opened_samples("csv", std::make_shared<const Dataset>(samples));
  ExportNotes notes;
  const auto luminance = values_to_write(source, samples.angles, one_channel(source.brdf->channels()), 1, notes);
  REQUIRE(luminance.size() == 1);
  CHECK(std::abs(luminance[0][0] - (0.2126 + 2 * 0.7152 - 3 * 0.0722)) < 1e-6);
  CHECK(notes.n_negative == samples.size());
  CHECK(notes.lost.size() == 1);
}

TEST_CASE("Samples on a grid are evaluated linearly between its nodes, others by their neighbours") {
  Dataset samples = product({0, 20, 40}, {0, 90, 180, 270});
  for (std::size_t k = 0; k < samples.size(); ++k) samples.f[0][k] = samples.angles[k].theta_o.degrees();
  const Opened grid = opened_grid("csv", std::make_shared<const Dataset>(samples));
  for (const double theta : {0.0, 7.0, 25.0, 40.0})
    for (const double phi : {0.0, 33.0, 181.0, 300.0})
      CHECK(std::abs(grid.brdf->eval(Direction::spherical(12_deg, 50_deg), Direction::spherical(degrees(theta), degrees(phi)))[0] - theta) <
            1e-9);
  // Light along the normal needs no more than one azimuth.
  Dataset once = samples;
  once.f[0].erase(once.f[0].begin() + 2, once.f[0].begin() + 5);
  once.angles.erase(once.angles.begin() + 2, once.angles.begin() + 5);
  REQUIRE(grid_of_samples(once));
  const Opened with_normal = opened_grid("csv", std::make_shared<const Dataset>(once));
  CHECK(std::abs(with_normal.brdf->eval(Direction(), Direction::spherical(25_deg, 200_deg))[0] - 25) < 1e-9);
  samples.angles.pop_back(), samples.f[0].pop_back();
  const Opened scattered = opened_grid("csv", std::make_shared<const Dataset>(samples));
  CHECK(scattered.brdf->eval(samples.angles[3].wi(), samples.angles[3].wo())[0] == samples.f[0][3]);
}
