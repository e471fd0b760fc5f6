// SPDX-License-Identifier: BSD-3-Clause
// What every renderer's file declares for the list in target.cpp.
#pragma once

#include "tabulated/targets/target.hpp"

namespace gonio::tabulated::targets {

RenderTarget disney_target();
RenderTarget glsl_target();
RenderTarget mitsuba_target();

}  // namespace gonio::tabulated::targets
