// SPDX-License-Identifier: BSD-3-Clause
// The claims of an OpenEXR header, held against the size of the file before the library believes them.
#pragma once

#include <filesystem>

namespace gonio::tabulated {

/// Walks through the attributes of every part and throws Error(input) if one claims more bytes than the file has left, which the OpenEXR
/// library would allocate first and miss afterwards, or another number than its type has, after which the library would lose its place,
/// or if a part has more pixels than the whole file could hold compressed, for which the library would make room. Anything else that is
/// wrong is for the library to say.
void require_sound_exr_header(const std::filesystem::path& path);

}  // namespace gonio::tabulated
