// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_job.hpp"

#include <chrono>
#include <filesystem>

#include "fitting/joint_observations.hpp"
#include "tabulated/formats/merl.hpp"

namespace gonio::tools {
namespace {

using Stopwatch = std::chrono::steady_clock;

double seconds_since(Stopwatch::time_point begin) { return std::chrono::duration<double>(Stopwatch::now() - begin).count(); }

}  // namespace

FitInput read_inputs(const std::vector<std::string>& files, const tabulated::ReadOptions& options, const Console& console) {
  const auto begin = Stopwatch::now();
  FitInput out;
  std::vector<Fault> faults;
  for (const std::string& file : files) {
    try {
      const tabulated::Opened opened = tabulated::open_brdf(file, options);
      if (!opened.observations)
        throw Error(ErrorKind::input, {file, opened.format + ", a model and not a measurement", "samples or a table"});
      console.note_masked(file, opened.masked);
      out.parts.push_back(opened.observations);
      out.masked.nan += opened.masked.nan;
      out.masked.missing += opened.masked.missing;
      out.masked.below_horizon += opened.masked.below_horizon;
      out.masked.blocked += opened.masked.blocked;
      out.simulated = out.simulated || opened.simulated;
    } catch (const Error& error) {
      if (files.size() == 1 || error.kind() != ErrorKind::input) throw;
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  if (!faults.empty()) throw Error(ErrorKind::input, "not every file can be read", std::move(faults));
  out.read_s = seconds_since(begin);
  return out;
}

std::vector<HashedInput> hash_inputs(const std::vector<std::string>& files, const tabulated::ReadOptions& options) {
  std::vector<HashedInput> out;
  for (const std::string& file : files) {
    out.push_back(hash_in_background(file));
    const std::filesystem::path sidecar = tabulated::merl_sidecar(file);
    if (std::error_code none; std::filesystem::path(file).extension() == ".binary" && std::filesystem::is_regular_file(sidecar, none))
      out.push_back(hash_in_background(sidecar));
  }
  if (options.blank) out.push_back(hash_in_background(*options.blank));
  return out;
}

FitOutcome fit_input(const FitInput& input, const fitting::FitOptions& options) {
  FitOutcome out;
  out.result = fitting::fit(*fitting::join(input.parts), options);
  out.timings.read_s = input.read_s;
  return out;
}

}  // namespace gonio::tools
