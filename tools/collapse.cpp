// SPDX-License-Identifier: BSD-3-Clause
// gonio collapse: the sufficient statistics of samples, for fits whose samples stand on several machines.
#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include "fitting/joint_observations.hpp"
#include "tools/fit_batch.hpp"
#include "tools/fit_job.hpp"
#include "tools/statistics_document.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {

int collapse_verb(const Arguments& arguments, Console& console) {
  CLI::App app("Reduces samples to what a fit of a model needs of them; gonio fit --merge adds up the parts and fits.", "collapse");
  std::vector<std::string> names;
  std::string out;
  FitFlags flags;
  app.add_option("FILE", names, "Any readable BRDF files, or folders of them, as one part")->required();
  flags.add_to(app);
  app.add_option("--out", out, "Write the statistics to this file")->required();
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const FitRequest request = flags.request();
  const std::vector<std::string> files = expand_folders(names);
  if (files.empty()) throw Error(ErrorKind::usage, {"gonio collapse", "no file", "FILE, or a folder with measurements in it"});
  Shard shard;
  shard.inputs = hash_inputs(files, request.read);
  const FitInput input = read_inputs(files, request.read, console);
  shard.statistics = fitting::sufficient_statistics(*fitting::join(input.parts), request.fit);
  shard.masked = input.masked;
  shard.simulated = input.simulated;
  shard.options = request.options;
  const Json document = statistics_document(shard, context(shard.inputs, std::nullopt, shard.simulated));
  write_file_atomically(out, document.dump(-1) + "\n");
  const fitting::SufficientStatistics& statistics = shard.statistics;
  if (console.json)
    console.print_json(document);
  else
    console.print(fmt::format("{}: {} samples in {} rows over {}", out, statistics.n_observations, statistics.row_count(),
                              fitting::name(statistics.depends_on)));
  return 0;
}

}  // namespace gonio::tools
