// SPDX-License-Identifier: BSD-3-Clause
// The one list of analytic models. A new model is one file in brdf/models and one line here.
#pragma once

#include <tuple>
#include <utility>

#include "brdf/models/abc.hpp"
#include "brdf/models/abc_microfacet.hpp"
#include "brdf/models/abg.hpp"
#include "brdf/models/ashikhmin_shirley.hpp"
#include "brdf/models/ashikhmin_shirley_anisotropic.hpp"
#include "brdf/models/blinn_phong.hpp"
#include "brdf/models/blinn_phong_exact.hpp"
#include "brdf/models/blinn_phong_ngan.hpp"
#include "brdf/models/cook_torrance.hpp"
#include "brdf/models/ggx.hpp"
#include "brdf/models/ggx_fresnel.hpp"
#include "brdf/models/ggx_separable.hpp"
#include "brdf/models/ggx_separable_fresnel.hpp"
#include "brdf/models/harvey_shack.hpp"
#include "brdf/models/k_correlation.hpp"
#include "brdf/models/lafortune.hpp"
#include "brdf/models/lambert.hpp"
#include "brdf/models/oren_nayar.hpp"
#include "brdf/models/phong.hpp"
#include "brdf/models/phong_1975.hpp"
#include "brdf/models/retro_blinn_phong.hpp"
#include "brdf/models/retro_phong.hpp"
#include "brdf/models/sgd.hpp"
#include "brdf/models/ward.hpp"
#include "brdf/models/ward_anisotropic.hpp"
#include "brdf/models/ward_duer_gm.hpp"
#include "brdf/models/ward_duer_gm_anisotropic.hpp"

namespace gonio {

using Models = std::tuple<Lambert,                                                              //
                          Phong1975, Phong, BlinnPhong, BlinnPhongExact, BlinnPhongNgan,        //
                          Lafortune, Ward, WardAnisotropic, WardDuerGm, WardDuerGmAnisotropic,  //
                          CookTorrance, Ggx, GgxSeparable, GgxFresnel, GgxSeparableFresnel,     //
                          AshikhminShirley, AshikhminShirleyAnisotropic, OrenNayar, Sgd,        //
                          Abc, AbcMicrofacet, Abg, HarveyShack, KCorrelation, RetroPhong, RetroBlinnPhong>;

/// Calls `f(Model{})` for every model of the list, in order.
template <class F>
void for_each_model(F&& f) {
  std::apply([&](auto... models) { (f(models), ...); }, Models{});
}

static_assert([]<class... M>(std::tuple<M...>*) { return (AnalyticModel<M> && ...); }(static_cast<Models*>(nullptr)));

}  // namespace gonio
