// SPDX-License-Identifier: BSD-3-Clause
// gonio check: the physics of a BRDF as statistics.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "fitting/checks/checks.hpp"
#include "tools/brdf_source.hpp"
#include "tools/output.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {

int check_verb(const Arguments& arguments, Console& console) {
  CLI::App app("Tests the physics of measured samples, tables and models. Several files are the same sample rotated.", "check");
  std::vector<std::string> files, parameters;
  std::string rotation, out;
  bool strict = false;
  fitting::CheckOptions options;
  ReadFlags flags;
  app.add_option("FILE", files, "Any readable BRDF file, or a model's name with --param")->required();
  app.add_option("--param", parameters, "NAME=VALUE of the model")->take_all();
  app.add_option("--rotation", rotation, "Rotation of the sample for each file, degrees: 0,45,90");
  app.add_option("--margin", options.margin, "Largest relative effect that does not matter (default 0.02)")->check(CLI::PositiveNumber);
  app.add_option("--where", options.where, "At most so many places that stand out are told per check (default 10)");
  app.add_flag("--strict", strict, "A warning fails too");
  app.add_option("--out", out, "Write the JSON document to this file");
  flags.add_to(app);
  add_common(app, console);
  if (!parse(app, arguments)) return 0;
  for (const std::string& part : comma_separated(rotation)) options.rotation_deg.push_back(number_from(part, "--rotation"));
  if (!options.rotation_deg.empty() && options.rotation_deg.size() != files.size())
    throw Error(ErrorKind::usage,
                {"--rotation", std::to_string(options.rotation_deg.size()) + " angles", std::to_string(files.size()) + ", one per file"});

  fitting::CheckSubject subject;
  std::vector<HashedInput> inputs;
  bool simulated = false;
  for (const std::string& file : files) {
    const tabulated::Opened opened = open_source(file, parameters, flags);
    if (opened.format != "model") inputs.push_back(hash_in_background(file));
    console.note_masked(file, opened.masked);
    simulated = simulated || opened.simulated;
    if (opened.dataset)
      subject.datasets.push_back(opened.dataset);
    else if (files.size() > 1)
      throw Error(ErrorKind::usage, {file, opened.format + ", which is not a set of samples",
                                     "one file, or several sets of samples of the same sample rotated"});
    else {
      subject.observations = opened.observations;
      subject.brdf = opened.brdf;
    }
  }
  const std::vector<fitting::Check> checks = fitting::run_checks(subject, options);

  if (console.json || !out.empty()) {
    const Json document = checks_document(checks, context(inputs, std::nullopt, simulated));
    if (!out.empty()) write_file_atomically(out, document.dump(2) + "\n");
    if (console.json) console.print_json(document);
  }
  if (!console.json)
    for (const std::string& line : check_lines(checks)) console.print(line);
  return std::any_of(checks.begin(), checks.end(),
                     [&](const fitting::Check& check) {
                       return check.verdict == fitting::Verdict::fail || (strict && check.verdict == fitting::Verdict::warn);
                     })
             ? 1
             : 0;
}

}  // namespace gonio::tools
