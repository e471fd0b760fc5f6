// SPDX-License-Identifier: BSD-3-Clause
// Several monochrome files of Zemax OpticStudio that are the channels of one BRDF.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tabulated/formats/zemax.hpp"

namespace gonio::tabulated {

/// OpticStudio takes one table of scatter per surface and wavelength, so a coloured BRDF becomes a file per channel. That they belong
/// together stands in comments, which it passes over: ` Channel 1 of 3 = r` names the file's own channel, ` Channel 2 of 3 in m-g.bsdf`
/// the others' files, in the same folder.
struct ZemaxSetPlace {
  std::size_t number = 0, count = 0;  ///< this file is channel `number` of `count`, from 1 on
  std::string channel;                ///< its name
  std::vector<std::string> files;     ///< [number - 1] names of the others' files; empty at its own place
};

/// NAME-CHANNEL.EXTENSION for each channel, letters that do not suit a file's name as `_`. Throws Error(input) if two are the same.
std::vector<std::filesystem::path> zemax_set_files(const std::filesystem::path& path, const Channels& channels);
std::vector<std::string> zemax_set_comments(const ZemaxSetPlace& place);
/// What the comments of a file say; nothing if they do not name every channel once, or name a file outside the folder.
std::optional<ZemaxSetPlace> zemax_set_place(const std::vector<std::string>& comments);

/// The whole set `first`, read from `path`, belongs to, as one table without the comments of sets; `missing` gets the names of files that
/// are not there, and the table is then `first` under the name of its channel. A file of no set is what it is.
/// Throws Error(input): a file of the set that cannot be read, has another grid or another place.
std::shared_ptr<const ZemaxTable> whole_zemax_set(std::shared_ptr<const ZemaxTable> first, const std::filesystem::path& path,
                                                  const ReadOptions& options, std::vector<std::string>& missing);

}  // namespace gonio::tabulated
