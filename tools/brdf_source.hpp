// SPDX-License-Identifier: BSD-3-Clause
// The flags that say how to read a BRDF, and SOURCE: a model's name or any BRDF file.
#pragma once

#include <string>
#include <vector>

#include "tabulated/open.hpp"
#include "tools/console.hpp"

namespace gonio::tools {

/// The reading flags shared by import, fit, check, export, eval and info.
struct ReadFlags {
  std::string format, columns, quantity, blank, in_plane, missing, merl_nodes;
  std::vector<std::string> set, assume;

  void add_to(CLI::App& app);
  /// Error(usage) for a value that no flag takes.
  tabulated::ReadOptions options() const;
};

/// Node convention by its name on the command line, `left` or `centre`.
tabulated::MerlNodes merl_nodes_named(const std::string& text);

/// A model by name with `NAME=VALUE` parameters (all of them are wanted), one channel called `value`.
tabulated::Opened model_source(const std::string& model, const std::vector<std::string>& parameters);
/// SOURCE: a model's name if there is one, else a file. Parameters with a file are an Error(usage).
tabulated::Opened open_source(const std::string& source, const std::vector<std::string>& parameters, const ReadFlags& flags);

}  // namespace gonio::tools
