// SPDX-License-Identifier: BSD-3-Clause
// What a fault says: the value that was found and the values that were wanted, in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data-schemas/json.hpp"

namespace gonio {

/// `"fast" (string)`, `400 (integer)`, `true (boolean)`, `null`, `an array of 3 elements`, `an object of 2 members`; long text is cut.
std::string found_text(const Json& value);

/// What an expanded schema allows: `a number from 0 to 360`, `one of "pass", "fail"`, `a string that matches ^0x[0-9a-f]+$`,
/// `null or an array of 2 elements`.
std::string wanted_text(const Json& schema);

/// What to write instead of an unknown member: the nearest known name if one is near, and all of them.
std::string wanted_member_text(std::string_view unknown, const std::vector<std::string>& known);

/// Number of characters to insert, delete or replace to make `a` from `b` (Levenshtein 1966), counted in bytes.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace gonio
