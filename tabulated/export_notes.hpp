// SPDX-License-Identifier: BSD-3-Clause
// What a writer says of the file it has written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gonio::tabulated {

/// What became of the data on the way into a file, and what the format could not hold. Counted are the nodes (pairs of directions, all
/// channels of a pair together) that the writer asked the BRDF for.
struct ExportNotes {
  std::vector<std::filesystem::path> files;                ///< everything that was written, the main file first
  std::size_t n_nodes = 0;                                 ///< pairs of directions asked for
  std::size_t n_below_horizon = 0;                         ///< nodes of the grid that are no pair of directions above the surface
  std::size_t n_unknown = 0;                               ///< pairs at which nothing is known; `lost` says what was written there
  std::size_t n_negative = 0;                              ///< pairs with a negative value; `lost` says what was written there
  std::size_t n_extrapolated = 0;                          ///< pairs beyond the samples or in a masked region
  std::vector<std::pair<std::string, std::string>> facts;  ///< grid, size, conventions of the target: key and words
  /// What the file does not say of itself: the answers a reader wants (`ReadOptions::assume`) to get back what was written.
  std::map<std::string, std::string> assume;
  std::vector<std::string> lost;  ///< one sentence per thing the file does not hold, or holds changed
};

}  // namespace gonio::tabulated
