// SPDX-License-Identifier: BSD-3-Clause
// The model that checks lean on: the ratio of data to it is smooth where the data are not.
#pragma once

#include <memory>

#include "brdf/analytic_brdf.hpp"
#include "brdf/dataset.hpp"

namespace gonio::fitting {

/// A Blinn-Phong fit of a data set, channel by channel; null where the fit did not converge or leaves a parameter undetermined, so that
/// nothing is built on a lobe the data do not resolve.
std::shared_ptr<const AnalyticBrdf> fitted_model(const std::shared_ptr<const Dataset>& dataset);

}  // namespace gonio::fitting
