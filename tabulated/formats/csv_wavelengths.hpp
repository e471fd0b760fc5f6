// SPDX-License-Identifier: BSD-3-Clause
// Samples with a row per wavelength, made into samples with a channel per wavelength.
#pragma once

#include <vector>

#include "brdf/dataset.hpp"
#include "tabulated/fault_list.hpp"

namespace gonio::tabulated {

/// `flat` has one channel, and `wavelength_nm[k]` is that of its sample k. The result has one channel `<wavelength>nm` for every wavelength
/// that occurs, in increasing order, and one sample for every direction, in the order of first appearance; NaN where a direction was not
/// measured at a wavelength. Repeats at the same direction and wavelength stay samples of their own. Faults for a data set with several
/// channels or with optional columns, which would not know their wavelength.
Dataset channels_by_wavelength(Dataset flat, const std::vector<double>& wavelength_nm, FaultList& faults);

}  // namespace gonio::tabulated
