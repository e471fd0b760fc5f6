// SPDX-License-Identifier: BSD-3-Clause
// Renderers that take a material's parameters instead of a table: their formulas, and the text they read.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/target_formula.hpp"

namespace gonio::tabulated::targets {

/// What a writer turns into text.
struct Material {
  ChannelValues values;               ///< of the form's formula: three channels r, g, b (linear sRGB)
  std::vector<std::string> comments;  ///< where the values come from, one line each: for the head of the file

  double shared(std::size_t parameter) const { return values.front()[parameter]; }
  std::array<double, 3> colour(std::size_t parameter) const { return {values[0][parameter], values[1][parameter], values[2][parameter]}; }
};

/// One of the materials a target knows, with the text that makes it.
struct Form {
  TargetFormula formula;
  /// A whole file. Its numbers read back to the same doubles, and its material evaluates to the formula with these values.
  std::string (*text)(const Material&);
};

/// A renderer. A new one is one file and one line in `render_targets()`.
struct RenderTarget {
  const char* name;  ///< as on the command line
  const char* description;
  const char* extension;                ///< dot included
  std::vector<Form> forms;              ///< a refit takes the one that comes nearest
  std::vector<std::string_view> notes;  ///< what a user of the file has to know
  /// Where `text` is no scene by itself and one can be made of it: that scene.
  std::string (*scene)(std::string_view comments, std::string_view text) = nullptr;
};
const std::vector<RenderTarget>& render_targets();

/// The formula of `Reference` and what its values say: ρd/π + Schlick's F times GGX with height-correlated shadowing, the lobe most
/// renderers' materials come from. Parameters rho_d, f0, f90, alpha, aspect.
const TargetFormula& reference_formula();
LobeSummary reference_summary(const ChannelValues& values);

/// alpha_x = alpha/aspect and alpha_y = alpha·aspect for an aspect of either side of 1.
struct Widths {
  double x, y;
};
Widths widths(double alpha, double aspect);

/// Shortest text that reads back to the same double; with a point or an exponent, so that every language takes it for a real number.
std::string real(double value);
/// Three of them, separated by `between`.
std::string triple(const std::array<double, 3>& colour, std::string_view between);
/// Every line of the comments after `mark`, each ended.
std::string commented(const std::vector<std::string>& comments, std::string_view mark);
/// `text` with every `{{NAME}}` replaced; a name that is not given is an Error(internal).
std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace gonio::tabulated::targets
