// SPDX-License-Identifier: BSD-3-Clause
// The samples a writer of scattered directions writes: the source's own, or the source sampled on a grid.
#pragma once

#include <memory>

#include "brdf/dataset.hpp"
#include "tabulated/export_notes.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// The samples of `source` unchanged if it has any; else its values at `direction_grid(options.size, symmetry)`, without the pairs at
/// which it knows nothing. Values keep their sign. Where the source knows its uncertainty, u is the total one, which no longer tells what
/// the samples share, and the column `coverage` is 0 for measured, 1 for interpolated and 2 for extrapolated values.
/// `notes` get the counts, the grid and what is lost. Throws Error(input) for a source that cannot be evaluated or knows nothing there.
std::shared_ptr<const Dataset> samples_to_write(const Opened& source, const WriteOptions& options, ExportNotes& notes);

/// For formats that cannot say that both sides of the plane of incidence are the same: isotropic and bilateral samples of which all lie on
/// one side, together with their mirror images. Anything else as it is.
std::shared_ptr<const Dataset> with_both_sides(std::shared_ptr<const Dataset> samples);

}  // namespace gonio::tabulated
