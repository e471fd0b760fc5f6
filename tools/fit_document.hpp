// SPDX-License-Identifier: BSD-3-Clause
// A fit as a document.
#pragma once

#include "fitting/fit.hpp"
#include "tools/output.hpp"

namespace gonio::tools {

/// Seconds spent outside the fit; `timings_s` of the document holds those inside too.
struct FitTimings {
  double read_s = 0, total_s = 0;
};
/// The document of `gonio fit` (data-schemas/fit.schema.json); `options` are the flags that shaped the result, null: none given.
Json fit_document(const fitting::FitResult& result, const MaskedCounts& masked, const FitTimings& timings, Json context, Json options = {});
/// Its members `parameters` and `errors`.
Json parameters_document(const fitting::FitResult& result);
Json errors_document(const fitting::FitErrors& errors);

}  // namespace gonio::tools
