// SPDX-License-Identifier: BSD-3-Clause
// Sufficient statistics as documents (data-schemas/statistics.schema.json).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "brdf/dataset.hpp"
#include "data-schemas/document.hpp"
#include "fitting/sufficient_statistics.hpp"

namespace gonio::tools {

/// Statistics and where they come from.
struct Shard {
  fitting::SufficientStatistics statistics;
  MaskedCounts masked;
  std::vector<HashedInput> inputs;  ///< the files of samples
  bool simulated = false;
  Json options;  ///< of `gonio collapse`
};

Json statistics_document(const Shard& shard, Json context);
/// Error(input) naming every fault: of the schema, columns of different lengths, rows with a weight but no sample or the reverse.
Shard read_statistics(const std::filesystem::path& path);
/// The same from a document that has been read; `source` names it in faults.
Shard statistics_from(const Json& document, const std::string& source);

/// All of them as one (fitting::merge). Error(input) also if a file of samples stands in two of them: it would count twice.
Shard merge_shards(const std::vector<Shard>& shards, const std::vector<std::string>& names);

}  // namespace gonio::tools
