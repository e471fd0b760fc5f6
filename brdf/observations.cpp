// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/observations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gonio {
namespace {

constexpr std::size_t block_size = 2048;  // enough blocks for several threads in a few thousand samples

class DatasetObservations final : public Observations {
 public:
  explicit DatasetObservations(std::shared_ptr<const Dataset> dataset) : dataset_(std::move(dataset)) {
    dataset_->require_consistent();
    for (const Channel& channel : dataset_->channels) {
      auto column = dataset_->extra.find("var_read_" + channel.name);
      if (column == dataset_->extra.end() && dataset_->channels.size() == 1) column = dataset_->extra.find("var_read");
      if (column != dataset_->extra.end()) read_variance_.push_back(&column->second);
    }
    if (read_variance_.size() != dataset_->channels.size()) read_variance_.clear();
  }

  const Channels& channels() const override { return dataset_->channels; }
  Symmetry symmetry() const override { return dataset_->symmetry; }
  std::size_t block_count() const override { return (dataset_->size() + block_size - 1) / block_size; }

  ObservationBlock block(std::size_t index) const override {
    ObservationBlock block;
    const std::size_t first = index * block_size;
    block.size = size_of(index);
    for (const auto& values : dataset_->f) block.f.push_back({values.data() + first});
    for (const auto& values : dataset_->u) block.u.push_back({values.data() + first});
    for (const auto* values : read_variance_) block.read_variance.push_back({values->data() + first});
    return block;
  }

  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override {
    out.resize(size_of(index));
    std::transform(first(index), first(index) + static_cast<std::ptrdiff_t>(out.size()), out.begin(),
                   [](const GonioAngles& angles) { return lobe_geometry(angles); });
  }

  void geometry_of(std::size_t index, std::span<const std::size_t> samples, std::vector<LobeGeometry>& out) const override {
    out.resize(samples.size());
    std::transform(samples.begin(), samples.end(), out.begin(),
                   [angles = first(index)](std::size_t sample) { return lobe_geometry(angles[static_cast<std::ptrdiff_t>(sample)]); });
  }

  void angles(std::size_t index, std::vector<GonioAngles>& out) const override {
    out.assign(first(index), first(index) + static_cast<std::ptrdiff_t>(size_of(index)));
  }

  Apertures apertures(std::size_t) const override { return dataset_->apertures; }
  std::vector<CorrelatedComponent> correlated() const override { return dataset_->correlated; }

 private:
  std::size_t size_of(std::size_t index) const { return std::min(block_size, dataset_->size() - index * block_size); }
  std::vector<GonioAngles>::const_iterator first(std::size_t index) const {
    return dataset_->angles.begin() + static_cast<std::ptrdiff_t>(index * block_size);
  }

  std::shared_ptr<const Dataset> dataset_;
  std::vector<const std::vector<double>*> read_variance_;  ///< one per channel, or empty
};

}  // namespace

void Observations::geometry_of(std::size_t index, std::span<const std::size_t> samples, std::vector<LobeGeometry>& out) const {
  std::vector<LobeGeometry> all;
  geometry(index, all);
  out.clear();
  for (const std::size_t sample : samples) out.push_back(all[sample]);
}

void Observations::facet_geometry(std::size_t index, FacetGeometry& out) const {
  std::vector<LobeGeometry> all;
  geometry(index, all);
  for (auto* column : {&out.tan2_h, &out.cos_i, &out.cos_o, &out.cos_d}) column->resize(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    out.tan2_h[k] = static_cast<float>(all[k].tan2_h);
    out.cos_i[k] = static_cast<float>(all[k].cos_i);
    out.cos_o[k] = static_cast<float>(all[k].cos_o);
    out.cos_d[k] = static_cast<float>(all[k].cos_d);
  }
}

void Observations::mirror_geometry(std::size_t index, MirrorGeometry& out) const {
  std::vector<LobeGeometry> all;
  geometry(index, all);
  for (auto* column : {&out.sin2_half_psi, &out.cos_i, &out.cos_o}) column->resize(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    out.sin2_half_psi[k] = -0.5 * std::expm1(all[k].log_cos_psi);
    out.cos_i[k] = all[k].cos_i;
    out.cos_o[k] = all[k].cos_o;
  }
}

std::unique_ptr<Observations> observe(std::shared_ptr<const Dataset> dataset) {
  return std::make_unique<DatasetObservations>(std::move(dataset));
}

}  // namespace gonio
