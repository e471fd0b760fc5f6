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
#include "brdf/uncertain_brdf.hpp"
#include "tabulated/export_notes.hpp"

namespace gonio::tabulated {

/// Where the first node of MERL's cells lies: at the cell's left edge or in its centre. Readers and writers differ (see docs).
enum class MerlNodes { left, centre };
/// What a cell of a MERL file that is to be written holds: the value at its node, or the mean over the cell.
enum class MerlValues { node, cell_mean };

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
  /// Answers to what a file of this format does not say, by the keys of `Format::assumptions` (`--assume KEY=VALUE`). A reader that needs
  /// an answer and has none refuses the file and names the key and the values it takes.
  std::map<std::string, std::string> assume;

  /// The answer to `key`, or nothing.
  std::optional<std::string> assumed(const std::string& key) const;
};

/// What a file turned out to be. Exactly one of `dataset` and `table`/`model` is the content; the others are views of it where
/// they make sense: a data set can be evaluated (interpolated) as `brdf`, everything measured can be fitted as `observations`.
struct Opened {
  std::string format;                                ///< csv, brdf-exr, merl, rgl, fit-json, ...
  std::shared_ptr<const Dataset> dataset;            ///< samples, or null
  std::shared_ptr<const Observations> observations;  ///< what the fitter and the checks read, or null for a model
  std::shared_ptr<const Brdf> brdf;                  ///< evaluable, or null
  std::shared_ptr<const UncertainBrdf> uncertain;    ///< `brdf` where it knows how sure it is, or null
  /// For people: size, angles covered, ... Every reader of a file says at least `holds` (f, f cos theta_o, reflectance factor, ...),
  /// `unit`, `nodes` (where values lie: at samples, cell edges, cell centres, means over patches) and `symmetry`.
  std::vector<std::pair<std::string, std::string>> info;
  MaskedCounts masked;
  bool simulated = false;
  Side side = Side::reflection;  ///< where outgoing directions lie: formats for reflection refuse transmission
};

/// Throws Error(input) naming the file, what was found and what was wanted; all faults at once.
Opened open_brdf(const std::filesystem::path& path, const ReadOptions& options = {});

/// How fine a grid to write where the format leaves it open; each writer states what it takes these for.
enum class GridSize { paper, standard, fine };

struct WriteOptions {
  MerlNodes merl_nodes = MerlNodes::left;
  MerlValues merl_values = MerlValues::node;
  GridSize size = GridSize::standard;
  /// Wanted mean relative error of what a reader of the file gets against the source: the writer takes the smallest grid that keeps it
  /// and notes the errors it chose from. Only for formats that are `adaptive`.
  std::optional<double> error;
  /// Also a scene that shows the file, for every renderer that loads it by itself. Formats that no renderer loads have none.
  bool scene = false;
  int threads = 2;
};

/// One file format. A new format is one file and one line in `formats()`; a variant that only a writer knows has no reader.
struct Format {
  const char* name;
  const char* description;
  /// From the first bytes (at most 4096) and the size of the file; null if write only.
  bool (*recognises)(std::string_view head, std::uintmax_t size);
  Opened (*open)(const std::filesystem::path&, const ReadOptions&);  ///< null if write only
  /// Writes whole or not at all; null if the format is read only.
  ExportNotes (*write)(const Opened&, const std::filesystem::path&, const WriteOptions&) = nullptr;
  const char* extension = "";                 ///< of the files written, dot included
  bool adaptive = false;                      ///< `WriteOptions::error` chooses the grid
  std::vector<const char*> assumptions = {};  ///< keys of `ReadOptions::assume` that the reader understands
  bool writes_samples = false;                ///< the source's own, where it has any: nothing is interpolated
};
const std::vector<Format>& formats();

}  // namespace gonio::tabulated
