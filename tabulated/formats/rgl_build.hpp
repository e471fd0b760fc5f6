// SPDX-License-Identifier: BSD-3-Clause
// The arrays of an RGL file for any BRDF.
#pragma once

#include <cstddef>
#include <string>

#include "tabulated/channel_map.hpp"
#include "tabulated/export_notes.hpp"
#include "tabulated/open.hpp"
#include "tabulated/rgl_table.hpp"

namespace gonio::tabulated {

/// Resolution of a file.
struct RglGrid {
  std::size_t phi_count = 1;                          ///< incidences around the normal, the last a whole turn after the first; 1: isotropic
  std::size_t theta_count = 32;                       ///< incidences from the normal to the horizon
  std::size_t value_count = 64;                       ///< values along each side of the warped square
  std::size_t density_count = 128;                    ///< the same for the density of visible half vectors
  std::size_t normal_rows = 2, normal_columns = 128;  ///< azimuths and zenith angles of ndf and sigma

  std::size_t bytes(std::size_t channel_count) const noexcept;
};

RglGrid rgl_grid(GridSize size, bool isotropic);
/// `32 x 64 x 64`, with the azimuths before it if there are any.
std::string words(const RglGrid& grid);

/// Evaluates the source at the nodes of the grid, which follow from its own retro-reflection, with the algorithm of Dupuy and Jakob 2018 on
/// the interpolants that the file will hold, so that the file gives back f at its nodes to the rounding of float. Other than there, a
/// part of the density of half vectors is broad: readers take any density, and the tails of narrow lobes get cells of their own.
///
/// What becomes of the source's values, counted in `notes`: negative ones are 0; a node where nothing is known takes the mean of those
/// beside it, of f cos theta_o over the microsurface of the file; a node below the horizon has the value of the horizon above it. A source
/// without azimuths is made its own mirror image: what left and right of the plane of incidence differ by is averaged. Throws Error(input)
/// for a source that cannot be evaluated, has unknown channels or no known value.
RglArrays build_rgl(const Opened& source, const RglGrid& grid, const ChannelMap& map, int threads, ExportNotes& notes);

}  // namespace gonio::tabulated
