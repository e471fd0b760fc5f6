// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/subset.hpp"

#include <utility>

#include "brdf/error.hpp"

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

}  // namespace gonio::fitting
