// SPDX-License-Identifier: BSD-3-Clause
// A set of samples as every reader of samples hands it out.
#pragma once

#include <memory>
#include <string>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// The samples as data set, as observations and, interpolated, as BRDF, with what there is to say about them.
Opened opened_samples(std::string format, std::shared_ptr<const Dataset> dataset);

}  // namespace gonio::tabulated
