// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/half_difference_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace gonio::tabulated {
namespace {

/// Two neighbouring nodes and the weight of the second.
struct Interval {
  std::size_t low, high;
  double weight;
};

Interval clamped(double position, std::size_t count) {
  const double at = std::clamp(position, 0.0, static_cast<double>(count - 1));
  const auto low = std::min(static_cast<std::size_t>(at), count - 2);
  return {low, low + 1, at - static_cast<double>(low)};
}

Interval periodic(double position, std::size_t count) {
  const double floor = std::floor(position);
  const auto n = static_cast<std::ptrdiff_t>(count);
  const auto low = static_cast<std::size_t>((static_cast<std::ptrdiff_t>(floor) % n + n) % n);
  return {low, (low + 1) % count, position - floor};
}

class MerlObservations final : public Observations {
 public:
  MerlObservations(MerlPlanes planes, MerlNodes nodes) : planes_(std::move(planes)), nodes_(nodes), channels_(rgb_channels()) {}

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {.isotropic = true, .bilateral = false, .reciprocal = true}; }
  std::size_t block_count() const override { return MerlGrid::theta_h_count; }

  ObservationBlock block(std::size_t row) const override {
    ObservationBlock out;
    out.size = MerlGrid::row_count;
    out.constant = ConstantOver::theta_h;
    out.log_cos_h = log_cos_h(row);
    out.validity = ObservationBlock::Validity::no_channel_negative;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      Column column = planes_.column(c);
      column.data = static_cast<const std::byte*>(column.data) + row * MerlGrid::row_count * sizeof(double);
      out.f.push_back(column);
    }
    return out;
  }

  void geometry(std::size_t row, std::vector<LobeGeometry>& out) const override {
    out.resize(MerlGrid::row_count);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = geometry_at(row, k);
  }

  void geometry_of(std::size_t row, std::span<const std::size_t> samples, std::vector<LobeGeometry>& out) const override {
    out.resize(samples.size());
    for (std::size_t j = 0; j < samples.size(); ++j) out[j] = geometry_at(row, samples[j]);
  }

  /// The cosines of wi and wo are cos θh cos θd ∓ sin θh sin θd cos φd.
  void facet_geometry(std::size_t row, FacetGeometry& out) const override {
    for (auto* column : {&out.tan2_h, &out.cos_i, &out.cos_o, &out.cos_d}) column->resize(MerlGrid::row_count);
    std::array<double, MerlGrid::phi_d_count> cos_phi;
    for (std::size_t p = 0; p < cos_phi.size(); ++p) cos_phi[p] = MerlGrid::node({row, 0, p}, nodes_).phi_d.cos();
    const auto tan2_h = static_cast<float>(std::expm1(-2 * log_cos_h(row)));
    std::fill(out.tan2_h.begin(), out.tan2_h.end(), tan2_h);
    for (std::size_t d = 0; d < MerlGrid::theta_d_count; ++d) {
      const HalfDifference node = MerlGrid::node({row, d, 0}, nodes_);
      const double middle = node.theta_h.cos() * node.theta_d.cos(), swing = node.theta_h.sin() * node.theta_d.sin();
      for (std::size_t p = 0; p < cos_phi.size(); ++p) {
        const std::size_t k = d * MerlGrid::phi_d_count + p;
        out.cos_i[k] = static_cast<float>(middle - swing * cos_phi[p]);
        out.cos_o[k] = static_cast<float>(middle + swing * cos_phi[p]);
        out.cos_d[k] = static_cast<float>(node.theta_d.cos());
      }
    }
  }

  /// cos psi = 2 cos θi cos θo - cos 2θd with the cosines as above: sin²(psi/2) = sin² θh (1 - sin² θd sin² φd).
  void mirror_geometry(std::size_t row, MirrorGeometry& out) const override {
    for (auto* column : {&out.sin2_half_psi, &out.cos_i, &out.cos_o}) column->resize(MerlGrid::row_count);
    std::array<double, MerlGrid::phi_d_count> cos_phi, sin2_phi;
    for (std::size_t p = 0; p < cos_phi.size(); ++p) {
      const Angle phi_d = MerlGrid::node({row, 0, p}, nodes_).phi_d;
      cos_phi[p] = phi_d.cos(), sin2_phi[p] = phi_d.sin() * phi_d.sin();
    }
    for (std::size_t d = 0; d < MerlGrid::theta_d_count; ++d) {
      const HalfDifference node = MerlGrid::node({row, d, 0}, nodes_);
      const double middle = node.theta_h.cos() * node.theta_d.cos(), swing = node.theta_h.sin() * node.theta_d.sin();
      const double sin2_h = node.theta_h.sin() * node.theta_h.sin(), sin2_d = node.theta_d.sin() * node.theta_d.sin();
      for (std::size_t p = 0; p < cos_phi.size(); ++p) {
        const std::size_t k = d * MerlGrid::phi_d_count + p;
        out.sin2_half_psi[k] = sin2_h * (1 - sin2_d * sin2_phi[p]);
        out.cos_i[k] = middle - swing * cos_phi[p];
        out.cos_o[k] = middle + swing * cos_phi[p];
      }
    }
  }

  void angles(std::size_t row, std::vector<GonioAngles>& out) const override {
    out.resize(MerlGrid::row_count);
    for (std::size_t k = 0; k < out.size(); ++k) {
      const DirectionPair pair = pair_of(row, k);
      out[k] = gonio_angles(pair.wi, pair.wo);
    }
  }

 private:
  LobeGeometry geometry_at(std::size_t row, std::size_t k) const {
    const DirectionPair pair = pair_of(row, k);
    LobeGeometry geometry = lobe_geometry(pair.wi, pair.wo);
    geometry.log_cos_h = log_cos_h(row);
    return geometry;
  }

  DirectionPair pair_of(std::size_t row, std::size_t k) const {
    return directions(MerlGrid::node(MerlGrid::cell(row * MerlGrid::row_count + k), nodes_));
  }

  /// ln cos = -1/2 ln(1 + tan²): keeps every digit at the small theta_h where the highlight is.
  double log_cos_h(std::size_t row) const {
    const Angle theta_h = MerlGrid::node({row, 0, 0}, nodes_).theta_h;
    const double tangent = theta_h.sin() / theta_h.cos();  // theta_h < 90° on both rules
    return -0.5 * std::log1p(tangent * tangent);
  }

  MerlPlanes planes_;
  MerlNodes nodes_;
  Channels channels_;
};

}  // namespace

Column MerlPlanes::column(std::size_t channel) const { return {first[channel], 1, Column::Type::f64, scale[channel]}; }

MerlPlanes MerlPlanes::owning(std::array<std::vector<double>, 3> values) {
  const auto kept = std::make_shared<const std::array<std::vector<double>, 3>>(std::move(values));
  MerlPlanes out;
  for (std::size_t c = 0; c < kept->size(); ++c) out.first[c] = (*kept)[c].data();
  out.owner = kept;
  return out;
}

HalfDifferenceTable::HalfDifferenceTable(MerlPlanes planes, MerlNodes nodes)
    : planes_(std::move(planes)), nodes_(nodes), channels_(rgb_channels()) {
  for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c] = planes_.column(c);
}

void HalfDifferenceTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  constexpr std::size_t channel_count = 3;
  for (std::size_t k = 0; k < wi.size(); ++k) {
    double* const out = f.data() + k * channel_count;
    if (!(wi[k].z() > 0) || !(wo[k].z() > 0)) {
      std::fill_n(out, channel_count, 0.0);
      continue;
    }
    const MerlGrid::Position at = MerlGrid::position(half_difference(wi[k], wo[k]), nodes_);
    const Interval h = clamped(at.theta_h, MerlGrid::theta_h_count), d = clamped(at.theta_d, MerlGrid::theta_d_count),
                   p = periodic(at.phi_d, MerlGrid::phi_d_count);
    double sum[channel_count] = {}, weights = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const bool high_h = corner & 1, high_d = corner & 2, high_p = corner & 4;
      const double weight = (high_h ? h.weight : 1 - h.weight) * (high_d ? d.weight : 1 - d.weight) * (high_p ? p.weight : 1 - p.weight);
      if (!(weight > 0)) continue;
      const std::size_t index = MerlGrid::index({high_h ? h.high : h.low, high_d ? d.high : d.low, high_p ? p.high : p.low});
      const double node[channel_count] = {columns_[0][index], columns_[1][index], columns_[2][index]};
      if (node[0] < 0 || node[1] < 0 || node[2] < 0) continue;
      for (std::size_t c = 0; c < channel_count; ++c) sum[c] += weight * node[c];
      weights += weight;
    }
    for (std::size_t c = 0; c < channel_count; ++c) out[c] = weights > 0 ? sum[c] / weights : std::numeric_limits<double>::quiet_NaN();
  }
}

std::unique_ptr<Observations> observe_merl(MerlPlanes planes, MerlNodes nodes) {
  return std::make_unique<MerlObservations>(std::move(planes), nodes);
}

}  // namespace gonio::tabulated
