// SPDX-License-Identifier: BSD-3-Clause
// Opening any file that holds a BRDF: by content, not by name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/observations.hpp"

namespace gonio::tabulated {

/// Where the first node of MERL's cells lies: at the cell's left edge or in its centre. Readers and writers differ (see docs).
enum class MerlNodes { left, centre };

/// Sign of in-plane zenith angles of files without azimuths.
enum class InPlane { specular_positive, specular_negative };

struct ReadOptions {
  std::optional<std::string> format;                         ///< overrides recognition by content
  std::vector<std::pair<std::string, std::string>> columns;  ///< NAME=column name or 1-based position
  std::map<std::string, double> set;                         ///< constants for columns the file does not have
  std::optional<Quantity> quantity;                          ///< what the file's values are; default f
  std::optional<std::filesystem::path> blank;                ///< subtracted value by value at equal directions before conversion
  std::optional<InPlane> in_plane;
  std::optional<double> missing = -1;   ///< a row whose channels are all exactly this is masked; nullopt: none
  std::optional<MerlNodes> merl_nodes;  ///< default: the sidecar's, else left
};

/// What a file turned out to be. Exactly one of `dataset` and `table`/`model` is the content; the others are views of it where
/// they make sense: a data set can be evaluated (interpolated) as `brdf`, everything measured can be fitted as `observations`.
struct Opened {
  std::string format;                                     ///< csv, brdf-exr, merl, rgl, fit-json, ...
  std::shared_ptr<const Dataset> dataset;                 ///< samples, or null
  std::shared_ptr<const Observations> observations;       ///< what the fitter and the checks read, or null for a model
  std::shared_ptr<const Brdf> brdf;                       ///< evaluable, or null
  std::vector<std::pair<std::string, std::string>> info;  ///< for people: size, angles covered, node rule, ...
  MaskedCounts masked;
  bool simulated = false;
};

/// Throws Error(input) naming the file, what was found and what was wanted; all faults at once.
Opened open_brdf(const std::filesystem::path& path, const ReadOptions& options = {});

struct WriteOptions {
  MerlNodes merl_nodes = MerlNodes::left;
  int threads = 2;
};

/// One file format. A new format is one file and one line in `formats()`.
struct Format {
  const char* name;
  const char* description;
  /// From the first bytes (at most 4096) and the size of the file.
  bool (*recognises)(std::string_view head, std::uintmax_t size);
  Opened (*open)(const std::filesystem::path&, const ReadOptions&);
  /// Writes whole or not at all; null if the format is read only.
  void (*write)(const Opened&, const std::filesystem::path&, const WriteOptions&);
};
const std::vector<Format>& formats();

}  // namespace gonio::tabulated
