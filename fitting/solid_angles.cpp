// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/solid_angles.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "brdf/error.hpp"

namespace gonio::fitting {
namespace {

constexpr double same_rad = 0.02 * std::numbers::pi / 180;  // what a drive misses a node by
constexpr double fewest_nodes = 0.5;                        // of a grid that must be there
constexpr double right_angle = std::numbers::pi / 2, turn = 2 * std::numbers::pi;

/// Distinct values, rising.
class Axis {
 public:
  explicit Axis(std::vector<double> values) : node_(std::move(values)) {
    std::sort(node_.begin(), node_.end());
    node_.erase(std::unique(node_.begin(), node_.end(), [](double a, double b) { return b - a < same_rad; }), node_.end());
  }
  std::size_t size() const { return node_.size(); }
  double operator[](std::size_t k) const { return node_[k]; }
  std::size_t of(double value) const {
    const auto after = std::upper_bound(node_.begin(), node_.end(), value + same_rad / 2);
    return after == node_.begin() ? 0 : static_cast<std::size_t>(after - node_.begin()) - 1;
  }
  /// Ends of the cell of a node, between 0 and 90°.
  std::pair<double, double> cell(std::size_t k) const {
    if (size() == 1) return {0, right_angle};
    const double below = k > 0 ? node_[k] - node_[k - 1] : node_[1] - node_[0];
    const double above = k + 1 < size() ? node_[k + 1] - node_[k] : below;
    return {std::max(0.0, node_[k] - below / 2), std::min(right_angle, node_[k] + above / 2)};
  }

 private:
  std::vector<double> node_;
};

/// Integrals over the cells of an axis of zenith angles.
template <class Integral>
std::vector<double> bands(const Axis& axis, Integral&& integral) {
  std::vector<double> out;
  for (std::size_t k = 0; k < axis.size(); ++k) {
    const auto [low, high] = axis.cell(k);
    out.push_back(integral(high) - integral(low));
  }
  return out;
}

double sine_integral(double theta) { return -std::cos(theta); }
double half_difference_integral(double theta_d) { return 2 * std::sin(theta_d) * std::sin(theta_d); }  // of 4 cos sin

/// Widths of the cells of azimuths: half the gaps on both sides. A gap more than twice the usual is where the data end.
std::vector<double> widths(const Axis& axis) {
  const std::size_t n = axis.size();
  std::vector<double> gap, out;
  for (std::size_t k = 0; k < n; ++k) gap.push_back(k + 1 < n ? axis[k + 1] - axis[k] : axis[0] + turn - axis[k]);
  std::vector<double> sorted = gap;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(n / 2), sorted.end());
  const double usual = sorted[n / 2];
  for (std::size_t k = 0; k < n; ++k) {
    const double before = gap[(k + n - 1) % n], after = gap[k];
    const bool ends_before = before > 2 * usual, ends_after = after > 2 * usual;
    out.push_back(ends_before && ends_after ? usual : ends_before ? after : ends_after ? before : (before + after) / 2);
  }
  return out;
}

bool is_half_difference_table(const Observations& observations) {
  for (std::size_t b = 0; b < observations.block_count(); ++b)
    if (observations.block(b).constant != ConstantOver::theta_h) return false;
  return observations.block_count() > 1;
}

std::vector<double> of_table(const Observations& observations) {
  std::vector<double> theta_h;
  for (std::size_t b = 0; b < observations.block_count(); ++b)
    theta_h.push_back(std::atan(std::sqrt(std::expm1(-2 * observations.block(b).log_cos_h))));
  const auto theta_d = [](const LobeGeometry& g) { return std::acos(std::min(1.0, g.cos_d)); };
  std::vector<LobeGeometry> geometry;
  observations.geometry(0, geometry);
  std::vector<double> differences;
  for (const LobeGeometry& g : geometry) differences.push_back(theta_d(g));
  const Axis half(theta_h), difference(std::move(differences));
  const std::vector<double> of_half = bands(half, sine_integral), of_difference = bands(difference, half_difference_integral);
  std::vector<double> out;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    observations.geometry(b, geometry);
    for (const LobeGeometry& g : geometry) out.push_back(of_half[half.of(theta_h[b])] * of_difference[difference.of(theta_d(g))]);
  }
  return out;
}

/// One side of the samples, the incident directions or the outgoing ones, as nodes of a grid.
class Side {
 public:
  Side(const std::vector<GonioAngles>& samples, Angle GonioAngles::*theta, Angle GonioAngles::*phi)
      : theta_(theta), phi_(phi), zenith_(values(samples, theta, false)), azimuth_(values(samples, phi, true)) {}

  std::size_t nodes() const { return zenith_.size() * azimuth_.size(); }
  bool pole(const GonioAngles& sample) const { return std::abs((sample.*theta_).radians()) < same_rad; }
  /// Number of the node; of the pole without an azimuth.
  std::size_t node(const GonioAngles& sample) const {
    const std::size_t azimuth = pole(sample) ? 0 : azimuth_.of(wrapped((sample.*phi_).radians()));
    return zenith_.of((sample.*theta_).radians()) * azimuth_.size() + azimuth;
  }
  /// Of every node, the pole with all azimuths.
  std::vector<double> measures() const {
    const std::vector<double> band = bands(zenith_, sine_integral), width = widths(azimuth_);
    const double whole = std::accumulate(width.begin(), width.end(), 0.0);
    std::vector<double> out;
    for (std::size_t z = 0; z < band.size(); ++z)
      for (std::size_t a = 0; a < width.size(); ++a) out.push_back(band[z] * (zenith_[z] < same_rad ? whole : width[a]));
    return out;
  }

 private:
  static double wrapped(double phi) {
    const double out = std::fmod(phi, turn);
    const double positive = out < 0 ? out + turn : out;
    return turn - positive < same_rad ? 0 : positive;
  }
  std::vector<double> values(const std::vector<GonioAngles>& samples, Angle GonioAngles::*which, bool azimuth) const {
    std::vector<double> out;
    for (const GonioAngles& sample : samples)
      if (!azimuth || !pole(sample)) out.push_back(azimuth ? wrapped((sample.*which).radians()) : (sample.*which).radians());
    if (out.empty()) out.push_back(0);
    return out;
  }

  Angle GonioAngles::*theta_;
  Angle GonioAngles::*phi_;
  Axis zenith_, azimuth_;
};

std::vector<double> of_grid(const Observations& observations) {
  std::vector<GonioAngles> samples, block;
  for (std::size_t b = 0; b < observations.block_count(); ++b) {
    observations.angles(b, block);
    samples.insert(samples.end(), block.begin(), block.end());
  }
  const Side in(samples, &GonioAngles::theta_i, &GonioAngles::phi_i), out(samples, &GonioAngles::theta_o, &GonioAngles::phi_o);
  std::map<std::pair<std::size_t, std::size_t>, double> count;  // readings of the same node share its cell
  for (const GonioAngles& sample : samples) count[{in.node(sample), out.node(sample)}] += 1;
  const double nodes = static_cast<double>(in.nodes()) * static_cast<double>(out.nodes());
  if (static_cast<double>(count.size()) < fewest_nodes * nodes)
    throw Error(ErrorKind::usage,
                {"weights solid_angle", fmt::format("scattered directions: {} of the {:.0f} nodes of a grid", count.size(), nodes),
                 "a table, or samples on a grid of theta_i, phi_i, theta_o and phi_o"});
  const std::vector<double> of_in = in.measures(), of_out = out.measures();
  std::vector<double> weight;
  for (const GonioAngles& sample : samples) {
    const std::pair node{in.node(sample), out.node(sample)};
    weight.push_back(of_in[node.first] * of_out[node.second] / count[node]);
  }
  return weight;
}

}  // namespace

std::vector<double> solid_angles(const Observations& observations) {
  std::vector<double> out = is_half_difference_table(observations) ? of_table(observations) : of_grid(observations);
  const double mean = std::accumulate(out.begin(), out.end(), 0.0) / static_cast<double>(std::max<std::size_t>(1, out.size()));
  if (mean > 0)
    for (double& weight : out) weight /= mean;
  return out;
}

}  // namespace gonio::fitting
