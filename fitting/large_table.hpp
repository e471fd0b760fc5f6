// SPDX-License-Identifier: BSD-3-Clause
// Terms of a table of hundreds of thousands of samples whose model cannot be collapsed: a sample of its rows, and the sums of all.
#pragma once

#include <memory>
#include <optional>

#include "brdf/observations.hpp"
#include "fitting/facet_table.hpp"
#include "fitting/row_sums.hpp"
#include "fitting/terms.hpp"

namespace gonio::fitting {

/// Sums of a table of facets, whose lobe is known at every value of alpha that a float can hold.
class FacetSums final : public RowSums {
 public:
  explicit FacetSums(std::shared_ptr<const FacetTable> table) : table_(std::move(table)) {}
  std::vector<Matrix> triangles(double alpha, int threads) const override;
  double nearest(double alpha) const override { return static_cast<float>(alpha); }
  std::shared_ptr<RowSums> few(int threads) const override;
  std::size_t rows() const noexcept override { return table_->rows(); }

 private:
  std::shared_ptr<const FacetTable> table_;
};

/// A table in two sizes.
struct LargeTable {
  /// With `sums`: the cost and its minimum are those of all samples. What takes single rows (covariance, adequacy) sees an even part of
  /// every block, with weights raised to stand for the whole.
  Terms terms;
  /// A few thousand rows, from which weights and outliers are judged.
  Terms part;
  std::shared_ptr<FacetTable> table;

  /// Weights 1/σ² of a variance model per channel at the fitted values, for the sums and the rows of `terms`.
  void weigh(const std::vector<VarianceModel>& variance, const std::vector<std::vector<double>>& linear, const std::vector<double>& theta,
             int threads);
};

/// None if the model is no microfacet lobe with Schlick's reflectance, the metric is not `linear`, the data carry uncertainties or shared
/// components, a sample misses a channel, or there are few samples: then make_terms is the way.
std::optional<LargeTable> large_table(const Observations& observations, const ModelKernel& kernel, Metric metric, int threads);

}  // namespace gonio::fitting
