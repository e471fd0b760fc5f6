// SPDX-License-Identifier: BSD-3-Clause
// The distribution of normals that files of the RGL database are adapted to, from retro-reflection.
#pragma once

#include <cstddef>
#include <vector>

#include "tabulated/export_notes.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// Distribution of normals D and projected area sigma(w) = ∫ max(0, w·m) D(m) dm over the unit square of directions
/// (tabulated/rgl_table.hpp), both divided by sigma of the normal. Rows are azimuths from -pi to pi with both ends (two equal rows: it
/// depends on theta only), columns go from theta 0 to pi/2 evenly in u.x.
struct Microsurface {
  std::size_t rows = 0, columns = 0;
  std::vector<float> ndf, sigma;
};

/// The distribution whose single scattering gives this retro-reflection: for a microfacet surface f(w, w) cos theta = D(w) / (4 sigma(w)),
/// so that D is an eigenvector of D(w) = lambda f(w, w) cos theta · sigma(w), found by four steps of power iteration (Dupuy and Jakob 2018,
/// section 4.1). `retro` has f(w, w) cos theta >= 0 at the nodes, not all of them 0. D is kept above a floor: it stands in a denominator.
/// A distribution that fits badly costs resolution, not truth: values at nodes are exact for any.
Microsurface microsurface_of(const std::vector<double>& retro, std::size_t rows, std::size_t columns, int threads);

/// f(w, w) cos theta in luminance at the nodes of a microsurface, what is negative as 0. Where nothing is known of the retro-reflection (a
/// detector stands in its own light) it is that of the pair with the same half vector and the least angle between the directions that is
/// known, else interpolated along theta_i; `notes` say of how many nodes that holds. With one azimuth (`rows` = 2) the source counts as
/// isotropic.
std::vector<double> retro_reflection(const Opened& source, std::size_t rows, std::size_t columns, int threads, ExportNotes& notes);

/// Incidences between which sigma, averaged over azimuths, falls by equal steps, from 0 to pi/2: `count` >= 2 angles in radians.
std::vector<float> incidences_of(const Microsurface& surface, std::size_t count);

}  // namespace gonio::tabulated
