// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/subset.hpp"

#include <tuple>
#include <utility>

#include "brdf/error.hpp"
#include "fitting/joint_observations.hpp"

namespace gonio::fitting {
namespace {

class SubsetObservations final : public Observations {
 public:
  SubsetObservations(std::shared_ptr<const Observations> all, std::vector<std::uint8_t> keep)
      : all_(std::move(all)), keep_(std::move(keep)) {
    std::size_t first = 0;
    for (std::size_t b = 0; b < all_->block_count(); ++b) {
      const ObservationBlock block = all_->block(b);
      first_.push_back(first);
      for (std::size_t k = 0; k < block.size; ++k, ++first)
        if (keep_[first] && !block.valid(k)) keep_[first] = 0;
    }
  }

  const Channels& channels() const override { return all_->channels(); }
  Symmetry symmetry() const override { return all_->symmetry(); }
  std::size_t block_count() const override { return first_.size(); }
  ObservationBlock block(std::size_t index) const override {
    ObservationBlock block = all_->block(index);
    block.validity = ObservationBlock::Validity::mask;
    block.mask = keep_.data() + first_[index];
    return block;
  }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override { all_->geometry(index, out); }
  void geometry_of(std::size_t index, std::span<const std::size_t> samples, std::vector<LobeGeometry>& out) const override {
    all_->geometry_of(index, samples, out);
  }
  void angles(std::size_t index, std::vector<GonioAngles>& out) const override { all_->angles(index, out); }
  Apertures apertures(std::size_t index) const override { return all_->apertures(index); }
  std::vector<CorrelatedComponent> correlated() const override { return all_->correlated(); }

 private:
  std::shared_ptr<const Observations> all_;
  std::vector<std::uint8_t> keep_;  ///< one per sample: kept and a measurement
  std::vector<std::size_t> first_;  ///< number of the first sample of every block
};

/// An empty data set for samples like those of a block.
std::shared_ptr<Dataset> like(const Observations& observations, const ObservationBlock& block, const Apertures& apertures,
                              const std::vector<CorrelatedComponent>& stated) {
  auto out = std::make_shared<Dataset>();
  out->channels = observations.channels();
  out->symmetry = observations.symmetry();
  out->apertures = apertures;
  out->f.resize(block.f.size());
  out->u.resize(block.u.size());
  for (const CorrelatedComponent& component : stated) out->correlated.push_back({component.name, component.u, {}});
  return out;
}

bool same(const Apertures& a, const Apertures& b) {
  const auto all = [](const Apertures& of) {
    return std::tie(of.source_half_angle_deg, of.receiver_half_angle_deg, of.spot_diameter_m, of.field_diameter_m);
  };
  return all(a) == all(b);
}

}  // namespace

std::size_t sample_count(const Observations& observations) {
  std::size_t count = 0;
  for (std::size_t b = 0; b < observations.block_count(); ++b) count += observations.block(b).size;
  return count;
}

std::shared_ptr<const Observations> subset(std::shared_ptr<const Observations> all, std::vector<std::uint8_t> keep) {
  if (const std::size_t size = sample_count(*all); size != keep.size())
    throw Error(ErrorKind::internal, {"subset", std::to_string(keep.size()) + " marks", std::to_string(size) + " for as many samples"});
  return std::make_shared<SubsetObservations>(std::move(all), std::move(keep));
}

std::shared_ptr<const Observations> copied(const Observations& all, const std::vector<std::uint8_t>& keep) {
  const std::vector<CorrelatedComponent> stated = all.correlated();
  std::vector<std::shared_ptr<Dataset>> parts;
  std::vector<GonioAngles> angles;
  bool with_read = false;
  for (std::size_t b = 0, first = 0; b < all.block_count(); ++b) {
    const ObservationBlock block = all.block(b);
    const Apertures apertures = all.apertures(b);
    const bool read = !block.read_variance.empty();
    if (parts.empty() || !same(parts.back()->apertures, apertures) || parts.back()->u.size() != block.u.size() || with_read != read)
      parts.push_back(like(all, block, apertures, stated));
    with_read = read;
    Dataset& out = *parts.back();
    all.angles(b, angles);
    for (std::size_t k = 0; k < block.size; ++k) {
      if (!keep[first + k] || !block.valid(k)) continue;
      out.angles.push_back(angles[k]);
      for (std::size_t e = 0; e < stated.size(); ++e)
        if (!stated[e].sensitivity.empty()) out.correlated[e].sensitivity.push_back(stated[e].sensitivity[first + k]);
      for (std::size_t c = 0; c < block.f.size(); ++c) out.f[c].push_back(block.f[c][k]);
      for (std::size_t c = 0; c < block.u.size(); ++c) out.u[c].push_back(block.u[c][k]);
      for (std::size_t c = 0; c < block.read_variance.size(); ++c)
        out.extra["var_read_" + out.channels[c].name].push_back(block.read_variance[c][k]);
    }
    first += block.size;
  }
  while (parts.size() > 1 && parts.back()->size() == 0) parts.pop_back();
  std::vector<std::shared_ptr<const Observations>> observed;
  for (auto& part : parts) observed.push_back(observe(std::move(part)));
  return join(std::move(observed));
}

}  // namespace gonio::fitting
