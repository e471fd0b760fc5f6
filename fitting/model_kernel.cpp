// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/model_kernel.hpp"

#include <ceres/jet.h>

#include <algorithm>
#include <vector>

#include "brdf/error.hpp"
#include "brdf/models.hpp"

namespace gonio::fitting {
namespace {

/// Columns [linear][rows] and slopes [nonlinear][linear][rows] of one model of the list.
template <AnalyticModel M>
void with_slopes(std::span<const LobeGeometry> geometry, const double* nonlinear, double* columns, double* slopes) {
  constexpr std::size_t linear = linear_count<M>(), count = nonlinear_count<M>();
  using Jet = ceres::Jet<double, static_cast<int>(std::max<std::size_t>(count, 1))>;
  std::array<Jet, std::max<std::size_t>(count, 1)> at;
  for (std::size_t j = 0; j < count; ++j) at[j] = Jet(nonlinear[j], static_cast<int>(j));
  std::array<Jet, linear> out{};
  const std::size_t rows = geometry.size();
  for (std::size_t row = 0; row < rows; ++row) {
    M::basis(geometry[row], at.data(), out.data());
    for (std::size_t k = 0; k < linear; ++k) {
      columns[k * rows + row] = out[k].a;
      for (std::size_t j = 0; j < count; ++j) slopes[(j * linear + k) * rows + row] = out[k].v[static_cast<int>(j)];
    }
  }
}

using WithSlopes = void (*)(std::span<const LobeGeometry>, const double*, double*, double*);

WithSlopes with_slopes_of(const ModelInfo& model) {
  static const std::vector<WithSlopes> list = [] {
    std::vector<WithSlopes> all;
    for_each_model([&]<AnalyticModel M>(M) { all.push_back(&with_slopes<M>); });
    return all;
  }();
  return list[static_cast<std::size_t>(&model - model_infos().data())];
}

}  // namespace

void ModelKernel::basis_and_slopes(std::span<const LobeGeometry> geometry, const double* nonlinear_values, double* columns, double* slopes,
                                   std::size_t stride) const {
  const std::size_t rows = geometry.size();
  // A basis function does not move with the parameters of the other terms.
  for (std::size_t j = 0; j < nonlinear; ++j)
    for (std::size_t k = 0; k < linear; ++k) std::fill_n(slopes + (j * linear + k) * stride, rows, 0.0);
  std::vector<double> own_columns, own_slopes;
  for (const ModelTerm& term : info->terms) {
    const std::size_t own_linear = term.model->linear_count, own_nonlinear = term.model->nonlinear_count();
    own_columns.resize(own_linear * rows);
    own_slopes.resize(own_nonlinear * own_linear * rows);
    with_slopes_of (*term.model)(geometry, nonlinear_values + term.nonlinear, own_columns.data(), own_slopes.data());
    for (std::size_t k = term.first_basis; k < own_linear; ++k) {
      const std::size_t at = term.linear + k - term.first_basis;
      std::copy_n(own_columns.data() + k * rows, rows, columns + at * stride);
      for (std::size_t j = 0; j < own_nonlinear; ++j)
        std::copy_n(own_slopes.data() + (j * own_linear + k) * rows, rows, slopes + ((term.nonlinear + j) * linear + at) * stride);
    }
  }
}

ModelKernel model_kernel(std::string_view model) {
  ModelKernel kernel;
  kernel.info = &model_info(model);
  kernel.linear = kernel.info->linear_count;
  kernel.nonlinear = kernel.info->nonlinear_count();
  if (kernel.linear > max_linear)
    throw Error(ErrorKind::usage, {"model '" + std::string(model) + "'", std::to_string(kernel.linear) + " linear parameters",
                                   "at most " + std::to_string(max_linear)});
  return kernel;
}

}  // namespace gonio::fitting
