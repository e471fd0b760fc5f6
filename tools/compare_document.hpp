// SPDX-License-Identifier: BSD-3-Clause
// The result of a comparison as a document and as text.
#pragma once

#include <string>
#include <vector>

#include "data-schemas/json.hpp"
#include "fitting/compare.hpp"

namespace gonio::tools {

/// What stands on one side.
struct ComparedSource {
  std::string source, format;
};

/// The document of `gonio compare` (data-schemas/compare.schema.json); `images` are the pictures that were written.
Json compare_document(const ComparedSource& a, const ComparedSource& b, const fitting::ComparedValues& values,
                      const fitting::Comparison& comparison, Angle theta_max, const std::vector<std::string>& images, Json context);

/// The same for people.
std::vector<std::string> compare_lines(const fitting::ComparedValues& values, const fitting::Comparison& comparison, Angle theta_max);

}  // namespace gonio::tools
