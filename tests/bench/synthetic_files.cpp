// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/synthetic_files.hpp"

#include <cmath>
#include <fstream>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "brdf/channels.hpp"
#include "tabulated/formats/merl.hpp"
#include "tabulated/merl_grid.hpp"

namespace gonio::bench {
namespace {

constexpr unsigned long long seed = 20260701;

class Noise {
 public:
  explicit Noise(unsigned long long from) : random_(from) {}
  double operator()(double f) { return f + std::hypot(0.01 * f, 1e-4) * normal_(random_); }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace

AnalyticBrdf blinn_phong(double s) {
  return AnalyticBrdf("blinn-phong-ngan", rgb_channels(), {{0.20, 0.30, s}, {0.15, 0.30, s}, {0.10, 0.30, s}});
}

AnalyticBrdf ggx(double alpha) {
  return AnalyticBrdf("ggx", rgb_channels(), {{0.20, 0.05, 0.9, alpha}, {0.15, 0.05, 0.9, alpha}, {0.10, 0.05, 0.9, alpha}});
}

void write_merl_file(const std::filesystem::path& path, const AnalyticBrdf& truth, double least_cosine) {
  using tabulated::MerlGrid;
  Noise noise(seed);
  std::vector<double> planes(3 * MerlGrid::cell_count);
  for (std::size_t k = 0; k < MerlGrid::cell_count; ++k) {
    const DirectionPair pair = directions(MerlGrid::node(MerlGrid::cell(k), tabulated::MerlNodes::centre));
    double f[3] = {-1, -1, -1};
    if (tabulated::above_horizon(pair) && pair.wi.z() > least_cosine && pair.wo.z() > least_cosine) {
      truth.eval(std::span(&pair.wi, 1), std::span(&pair.wo, 1), f);
      for (std::size_t c = 0; c < 3; ++c) f[c] = noise(f[c]) / tabulated::MerlPlanes::file_scale[c];
    }
    for (std::size_t c = 0; c < 3; ++c) planes[c * MerlGrid::cell_count + k] = f[c];
  }
  const std::int32_t dimensions[3] = {MerlGrid::theta_h_count, MerlGrid::theta_d_count, MerlGrid::phi_d_count};
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(dimensions), sizeof dimensions);
  file.write(reinterpret_cast<const char*>(planes.data()), static_cast<std::streamsize>(planes.size() * sizeof(double)));
  std::ofstream(tabulated::merl_sidecar(path)) << "{\"node_rule\": \"centre\", \"context\": {\"simulated\": true}}\n";
}

void write_csv_file(const std::filesystem::path& path, const AnalyticBrdf& truth) {
  Noise noise(seed);
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,r,g,b\n";
  for (int i = 0; i < 9; ++i)
    for (int o = 0; o < 36; ++o)
      for (int a = 0; a < 36; ++a) {
        const double theta_i = 10 * i, theta_o = 2.5 * o, phi_o = 10 * a;
        const auto f = truth.eval(GonioAngles{degrees(theta_i), degrees(0), degrees(theta_o), degrees(phi_o)});
        text += fmt::format("{},0,{},{},{},{},{}\n", theta_i, theta_o, phi_o, noise(f[0]), noise(f[1]), noise(f[2]));
      }
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace gonio::bench
