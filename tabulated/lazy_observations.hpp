// SPDX-License-Identifier: BSD-3-Clause
// The cells of a table as samples, made when they are first asked for.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "brdf/observations.hpp"

namespace gonio::tabulated {

/// A table is mostly opened to be evaluated: only the fitter pays for samples.
class LazyObservations final : public Observations {
 public:
  LazyObservations(Channels channels, Symmetry symmetry, std::function<Dataset()> samples)
      : channels_(std::move(channels)), symmetry_(symmetry), make_(std::move(samples)) {}

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return symmetry_; }
  std::size_t block_count() const override { return samples().block_count(); }
  ObservationBlock block(std::size_t index) const override { return samples().block(index); }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override { samples().geometry(index, out); }
  void angles(std::size_t index, std::vector<GonioAngles>& out) const override { samples().angles(index, out); }

 private:
  const Observations& samples() const {
    std::call_once(once_, [this] { samples_ = observe(std::make_shared<const Dataset>(make_())); });
    return *samples_;
  }

  Channels channels_;
  Symmetry symmetry_;
  std::function<Dataset()> make_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<Observations> samples_;
};

}  // namespace gonio::tabulated
