// SPDX-License-Identifier: BSD-3-Clause
// Everything a data set says about itself besides its samples, as pairs of text: how CSV comments and EXR attributes carry it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "brdf/dataset.hpp"

namespace gonio::tabulated {

struct Metadata {
  Dataset description;              ///< everything of a data set but its samples
  std::vector<std::string> extras;  ///< names of the columns that are neither angle nor channel nor uncertainty
};

/// Keys, each at most once:
/// `channel.<k>` (name of the k-th channel, from 1), `channel.<k>.<field>` (wavelength_in_nm, wavelength_out_nm, bandwidth_nm,
/// polarisation_in, polarisation_out), `extra.<k>` (name of a column kept as it came), `symmetry` (words), `side`, `simulated`,
/// `aperture.<field>`, `correlated.<name>` (its u), `masked.<reason>`, `provenance.<key>`.
std::vector<std::pair<std::string, std::string>> metadata_entries(const Dataset& dataset);

/// Takes one pair; false if the key is not known or the value is not of its kind. Channels must come in order, each before its fields.
bool read_metadata_entry(const std::string& key, const std::string& value, Metadata& metadata);

}  // namespace gonio::tabulated
