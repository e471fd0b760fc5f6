// SPDX-License-Identifier: BSD-3-Clause
// Renderers that take parameters, as formats that can be written: any BRDF is re-fitted to their own formula first.
#pragma once

#include <vector>

#include "tabulated/open.hpp"

namespace gonio::tools {

/// One format per entry of `tabulated::targets::render_targets()`; write only. A source of one channel becomes grey, spectra are seen under
/// D65. The notes hold the parameters, the error of a naive conversion and that of the refit, and what the target cannot express.
const std::vector<tabulated::Format>& renderer_formats();

}  // namespace gonio::tools
