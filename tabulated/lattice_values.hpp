// SPDX-License-Identifier: BSD-3-Clause
// A BRDF at the nodes of a lattice that is to be written.
#pragma once

#include <vector>

#include "tabulated/channel_map.hpp"
#include "tabulated/export_notes.hpp"
#include "tabulated/lattice_table.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// f at the nodes, [channel of `map`][index] in 1/sr; NaN where nothing is known and beyond the horizon, negative values as they are. The
/// source's own numbers if it is a table on this lattice. Where the lattice folds the two sides of the plane of incidence and the source
/// does not, both are evaluated and averaged. `notes` get the counts and what is lost. Throws Error(input) for a source that cannot be
/// evaluated, that scatters to the other side, or that has an azimuth where the lattice has none.
std::vector<std::vector<double>> lattice_values(const Opened& source, const Lattice& lattice, const ChannelMap& map, int threads,
                                                ExportNotes& notes);

/// Fills nodes without a value from the node before along the third angle (nearer to the surface normal or to the specular direction), at
/// its beginning along the first, and with 0 where there is none: for formats whose readers interpolate with every number. Returns how many
/// were filled.
std::size_t fill_unknown(const Lattice& lattice, std::vector<std::vector<double>>& values);

}  // namespace gonio::tabulated
