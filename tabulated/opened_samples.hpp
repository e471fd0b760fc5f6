// SPDX-License-Identifier: BSD-3-Clause
// A set of samples, or a table, as every reader hands it out.
#pragma once

#include <memory>
#include <string>

#include "tabulated/lattice_table.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// The samples as data set, as observations and, interpolated, as BRDF, with what there is to say about them.
Opened opened_samples(std::string format, std::shared_ptr<const Dataset> dataset);

/// The same for the nodes of a table, which is evaluated itself. Throws Error(input), naming `file`, if no node has a value.
Opened opened_table(std::string format, std::shared_ptr<const LatticeTable> table, const std::string& file);

}  // namespace gonio::tabulated
