// SPDX-License-Identifier: BSD-3-Clause
// What a writer of a text format writes, and where: the values at given poses, and the grid the source already has.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "brdf/coordinates.hpp"
#include "tabulated/channel_map.hpp"
#include "tabulated/direction_grid.hpp"
#include "tabulated/export_notes.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// One channel stays what it is; several become X, Y, Z, or the luminance Y alone.
ChannelMap one_channel_or_xyz(const Channels& channels);
ChannelMap one_channel(const Channels& channels);

/// f of `source` at `poses`, [channel of the file][pose] in the digits of single precision; NaN where nothing is known, negative values as
/// they are. `notes` get the counts and what the map changes. Throws Error(input) for a source that cannot be evaluated.
std::vector<std::vector<double>> values_to_write(const Opened& source, std::span<const GonioAngles> poses, const ChannelMap& map,
                                                 int threads, ExportNotes& notes);

/// The lists of angles if the samples of an isotropic source are all nodes of a product of zenith angles and azimuths from that of the
/// light, none missing (in transmission theta_o counts from -z; at
/// theta_i = 0 one azimuth is enough); else nothing.
std::optional<DirectionGrid> grid_of_samples(const Dataset& samples);

/// The samples as `opened_samples` hands them out; evaluated linearly between the nodes of their grid if `grid_of_samples` finds one.
Opened opened_grid(std::string format, std::shared_ptr<const Dataset> samples);

}  // namespace gonio::tabulated
