// SPDX-License-Identifier: BSD-3-Clause
// The correlated components of a data set as a fit meets them: a common scale apart from errors that change the shape.
#pragma once

#include <optional>
#include <vector>

#include "brdf/dataset.hpp"
#include "fitting/linearisation.hpp"

namespace gonio::fitting {

struct SharedErrors {
  /// Relative standard uncertainty of the factor that all samples have in common; none if the data state no such component.
  std::optional<double> u_scale;
  std::vector<CorrelatedComponent> shape;  ///< all other components
};

/// A component with the same sensitivity for every sample multiplies all readings by one factor. Every model is linear in its amplitudes
/// (ModelKernel), so that such a factor moves the linear parameters by itself and nothing else, and no fit can tell it from them: it is
/// carried apart, in squares. Unless linear parameters are `held`, which fixes the scale: then it acts on the others like any component.
SharedErrors shared_errors(const std::vector<CorrelatedComponent>& components, bool held);

/// The change of φ(f) by one standard uncertainty of a component, at the measured values. Terms and component must outlive it.
Change change_by(const Terms& terms, const CorrelatedComponent& component);
std::vector<Change> changes_by(const Terms& terms, const std::vector<CorrelatedComponent>& components);

}  // namespace gonio::fitting
