// SPDX-License-Identifier: BSD-3-Clause
// Several sets of observations as one.
#pragma once

#include <memory>
#include <vector>

#include "brdf/observations.hpp"

namespace gonio::fitting {

/// All samples of all parts, in their order, nothing copied.
///
/// Correlated components of one name are one quantity: two parts that both state `scale` share it, and each keeps its own size of it (the
/// component stands with the largest u, the others' sensitivities shrink in proportion). A part without the component is not touched by
/// it. The symmetry is what holds by construction in every part.
/// Error(input) if there is no part, or if the parts differ in the names or wavelengths of their channels.
std::shared_ptr<const Observations> join(std::vector<std::shared_ptr<const Observations>> parts);

}  // namespace gonio::fitting
