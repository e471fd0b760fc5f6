// SPDX-License-Identifier: BSD-3-Clause
// gonio fit --model all: which model describes the data, and whether any does.
#pragma once

#include <string>
#include <vector>

#include "fitting/model_choice.hpp"
#include "tools/fit_flags.hpp"

namespace gonio::tools {

struct ChoiceFlags {
  std::size_t folds = 10;
  double margin = 0.1;

  void add_to(CLI::App& app);
};

/// The models that --model names: a list separated by commas, in which `all` stands for every model of the list with at most three
/// nonlinear parameters; several, or none where --model names a single one.
std::vector<std::string> several_models(const std::string& text);

/// Tries them on all files together and writes the choice (data-schemas/choice.schema.json). 0, or 1 if no model could be fitted.
int fit_choice(const std::vector<std::string>& files, const std::vector<std::string>& models, const FitRequest& request,
               const ChoiceFlags& flags, int jobs, const std::string& out, Console& console);

/// The document, and the table for people.
Json choice_document(const fitting::ModelChoice& choice, const MaskedCounts& masked, Json context, Json options);
std::vector<std::string> choice_lines(const fitting::ModelChoice& choice);

}  // namespace gonio::tools
