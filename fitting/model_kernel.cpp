// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/model_kernel.hpp"

#include <ceres/jet.h>

#include "brdf/models.hpp"

namespace gonio::fitting {
namespace {

template <AnalyticModel M>
void basis(std::span<const LobeGeometry> geometry, double s, double* columns, std::size_t stride) {
  std::array<double, linear_count<M>()> out{};
  for (std::size_t row = 0; row < geometry.size(); ++row) {
    M::basis(geometry[row], &s, out.data());
    for (std::size_t k = 0; k < out.size(); ++k) columns[k * stride + row] = out[k];
  }
}

template <AnalyticModel M>
void basis_and_slope(std::span<const LobeGeometry> geometry, double s, double* columns, double* slopes, std::size_t stride) {
  using Jet = ceres::Jet<double, 1>;
  std::array<Jet, linear_count<M>()> out{};
  const Jet exponent(s, 0);
  for (std::size_t row = 0; row < geometry.size(); ++row) {
    M::basis(geometry[row], &exponent, out.data());
    for (std::size_t k = 0; k < out.size(); ++k) {
      columns[k * stride + row] = out[k].a;
      slopes[k * stride + row] = out[k].v[0];
    }
  }
}

}  // namespace

ModelKernel model_kernel(std::string_view model) {
  ModelKernel kernel;
  kernel.info = &model_info(model);
  for_each_model([&]<AnalyticModel M>(M) {
    static_assert(nonlinear_count<M>() <= 1, "the profile is scanned over one nonlinear parameter");
    static_assert(linear_count<M>() <= max_linear);
    if (M::name != model) return;
    kernel.linear = linear_count<M>();
    kernel.has_exponent = nonlinear_count<M>() == 1;
    kernel.basis = &basis<M>;
    kernel.basis_and_slope = &basis_and_slope<M>;
    kernel.albedo_bound = [](double s, double* out) { M::albedo_bound(&s, out); };
  });
  return kernel;
}

}  // namespace gonio::fitting
