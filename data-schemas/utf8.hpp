// SPDX-License-Identifier: BSD-3-Clause
// UTF-8 text that is valid whatever the bytes were.
#pragma once

#include <string>
#include <string_view>

namespace gonio {

/// The text with every byte that is no part of a well-formed UTF-8 sequence (Unicode 15, table 3-7: no overlong forms, no surrogates,
/// nothing above U+10FFFF) replaced by U+FFFD. Valid text comes back unchanged.
std::string valid_utf8(std::string_view text);

}  // namespace gonio
