// SPDX-License-Identifier: BSD-3-Clause
// What every renderer's file declares for the list in target.cpp.
#pragma once

#include "tabulated/targets/target.hpp"

namespace gonio::tabulated::targets {

RenderTarget blender_target();
RenderTarget disney_target();
RenderTarget glsl_target();
RenderTarget gltf_target();
RenderTarget mitsuba_target();
RenderTarget open_pbr_target();
RenderTarget osl_target();
RenderTarget pbrt_target();
RenderTarget radiance_plastic_target();
RenderTarget radiance_target();
RenderTarget standard_surface_target();

}  // namespace gonio::tabulated::targets
