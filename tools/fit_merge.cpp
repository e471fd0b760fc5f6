// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_merge.hpp"

#include <chrono>

#include "tools/fit_document.hpp"
#include "tools/fit_lines.hpp"
#include "tools/statistics_document.hpp"

namespace gonio::tools {

int fit_merged(const std::vector<std::string>& files, const FitRequest& request, const std::string& out, Console& console) {
  using Stopwatch = std::chrono::steady_clock;
  const auto seconds_since = [](Stopwatch::time_point begin) { return std::chrono::duration<double>(Stopwatch::now() - begin).count(); };
  const auto start = Stopwatch::now();
  std::vector<HashedInput> inputs;
  std::vector<Shard> shards;
  for (const std::string& file : files) {
    inputs.push_back(hash_in_background(file));
    shards.push_back(read_statistics(file));
  }
  const Shard all = merge_shards(shards, files);
  inputs.insert(inputs.end(), all.inputs.begin(), all.inputs.end());
  fitting::FitOptions options = request.fit;
  if (!options.metric && all.options.contains("metric")) options.metric = all.statistics.metric;  // as it was named when collapsing
  FitTimings timings;
  timings.read_s = seconds_since(start);
  const fitting::FitResult result = fitting::fit(all.statistics, options);
  if (console.json || !out.empty()) {
    Json where_from = context(inputs, std::nullopt, all.simulated);
    timings.total_s = seconds_since(start);
    const Json document = fit_document(result, all.masked, timings, std::move(where_from), request.options);
    if (!out.empty()) write_file_atomically(out, document.dump(2) + "\n");
    if (console.json) console.print_json(document);
  }
  if (!console.json)
    for (const std::string& line : fit_lines(result, all.masked)) console.print(line);
  return result.status == fitting::Status::converged ? 0 : 1;
}

}  // namespace gonio::tools
