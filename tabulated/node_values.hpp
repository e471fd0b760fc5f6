// SPDX-License-Identifier: BSD-3-Clause
// A BRDF at the nodes of a grid that is to be written.
#pragma once

#include <span>
#include <vector>

#include "brdf/direction.hpp"
#include "tabulated/export_notes.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// What a writer gets for its nodes, node by node, all channels of one together.
struct NodeValues {
  std::size_t channel_count = 0;
  std::vector<double> f;           ///< [node · C + c] 1/sr, cosine not included; NaN where nothing is known, negative ones as they are
  std::vector<double> u;           ///< the same for the total standard uncertainty, NaN = unknown; empty if the source knows none
  std::vector<Coverage> coverage;  ///< [node]; empty if the source knows none
};

/// Evaluates `source.brdf` on `threads` threads and adds what was met to `notes` (n_nodes, n_unknown, n_negative, n_extrapolated); what
/// to write for a negative or unknown value is for the format to decide and to say. Throws Error(input) for a source that cannot be
/// evaluated and for an infinite value.
NodeValues node_values(const Opened& source, std::span<const Direction> wi, std::span<const Direction> wo, int threads, ExportNotes& notes);

}  // namespace gonio::tabulated
