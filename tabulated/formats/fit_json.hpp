// SPDX-License-Identifier: BSD-3-Clause
// The document of a fit, read as the model it describes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// A JSON object with a `context`: what every result of gonio starts with. Whether it is a fit the schema says.
bool recognises_fit_json(std::string_view head, std::uintmax_t size);

/// The model with the fitted values, channels in the order of `channels` or, without it, of their first parameters; a parameter
/// without a channel is shared by all. A fit that did not converge opens too and says so in `info`.
/// Throws Error(input) for a document that is no fit, an unknown model, a fit without values, or a parameter that is missing or
/// out of the model's bounds.
Opened open_fit_json(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace gonio::tabulated
