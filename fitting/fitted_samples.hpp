// SPDX-License-Identifier: BSD-3-Clause
// The samples of a fit beside the values the fit compared them with.
#pragma once

#include <cstddef>
#include <vector>

#include "brdf/observations.hpp"
#include "fitting/convolution.hpp"
#include "fitting/model_kernel.hpp"

namespace gonio::fitting {

/// Samples of one block that are no masked ones and not below the horizon.
struct FittedBlock {
  std::size_t first = 0;                    ///< number of the block's first sample in the observations
  std::vector<std::size_t> sample;          ///< numbers in the block
  std::vector<LobeGeometry> geometry;       ///< nominal
  std::vector<std::vector<double>> fitted;  ///< f̂ [channel][sample], 1/sr
};

/// A model as it was fitted: f̂ is the mean over the apertures for the samples where the fit took it.
class FittedSamples {
 public:
  /// `values` per channel in the order of the model; `means`: with numbers of samples instead of rows, one of all channels or one for
  /// each, or none. All of them must outlive this.
  FittedSamples(const Observations& observations, const ModelKernel& kernel, const std::vector<std::vector<double>>& values,
                const std::vector<MeanRows>& means);

  /// All samples up to 2^18 of them, else an even part of about 2^15 from every block, which keeps the cost of a whole table at a few
  /// milliseconds.
  FittedBlock block(std::size_t index) const;

 private:
  void put_means(std::size_t channel, FittedBlock& out) const;

  const Observations& observations_;
  const ModelKernel& kernel_;
  const std::vector<std::vector<double>>& values_;
  const std::vector<MeanRows>& means_;
  std::vector<std::size_t> first_;
  std::size_t stride_ = 1;
};

}  // namespace gonio::fitting
