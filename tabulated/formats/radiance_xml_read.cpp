// SPDX-License-Identifier: BSD-3-Clause
// Opening WINDOW's and Radiance's XML.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "tabulated/describe.hpp"
#include "tabulated/formats/radiance_xml.hpp"
#include "tabulated/formats/scattering_text.hpp"
#include "tabulated/formats/window_document.hpp"
#include "tabulated/klems_table.hpp"
#include "tabulated/lazy_observations.hpp"
#include "tabulated/radiance_colour.hpp"
#include "tabulated/tensor_tree_table.hpp"

namespace gonio::tabulated {
namespace {

constexpr const char* tree_basis = "LBNL/Shirley-Chiu";

/// The numbers of a block, in the order of a matrix with `in` varying fastest.
struct Matrix {
  const KlemsBasis *incident = nullptr, *outgoing = nullptr;
  std::vector<double> values;
  std::size_t unknown = 0;  ///< values that the file does not have
};

/// Reads the blocks of one file and collects what is wrong with them.
class BlockReader {
 public:
  BlockReader(const WindowDocument& document, FaultList& faults) : document_(document), faults_(faults) {}

  std::size_t negative() const noexcept { return negative_; }

  Matrix matrix(const WindowBlock& block) {
    Matrix out;
    out.incident = basis(block, block.column_basis, "ColumnAngleBasis");
    out.outgoing = basis(block, block.row_basis, "RowAngleBasis");
    if (!out.incident || !out.outgoing) return out;
    std::vector<double> numbers;
    ScatteringText text(block.data);
    while (text.peek() != '\0') {
      const std::optional<double> value = text.number();
      if (!value) {
        add(block, text.fault());
        return out;
      }
      negative_ += *value < 0 ? 1 : 0;
      numbers.push_back(std::max(0.0, *value));
    }
    place(block, numbers, out);
    return out;
  }

  std::optional<TensorTree> tree(const WindowBlock& block) {
    if (!same_word_of_window(block.basis, tree_basis)) {
      faults_.add_at(block.line, fmt::format("AngleBasis {}", excerpt(block.basis)), tree_basis);
      return std::nullopt;
    }
    ParsedTree parsed(block.data, document_.structure == WindowStructure::tree3 ? 3 : 4);
    if (!parsed.tree) add(block, parsed.fault);
    negative_ += parsed.negative;
    return std::move(parsed.tree);
  }

 private:
  void add(const WindowBlock& block, const TextFault& fault) {
    const std::size_t offset = block.data_offset + fault.offset;
    faults_.add_at(line_at(document_.text, offset), fmt::format("{} at byte {}", fault.found, offset), fault.wanted);
  }

  const KlemsBasis* basis(const WindowBlock& block, const std::string& name, const char* element) {
    const KlemsBasis* const found = document_.basis(name);
    if (!found) faults_.add_at(block.line, fmt::format("{} {}", element, excerpt(name)), "a basis of Klems or one the file defines");
    return found;
  }

  /// A file may hold the first n x n patches only, line by line (excerpts do); then the rest is unknown.
  void place(const WindowBlock& block, const std::vector<double>& numbers, Matrix& out) {
    const std::size_t ins = out.incident->size(), outs = out.outgoing->size();
    const bool rows = document_.structure == WindowStructure::rows;
    std::size_t given_ins = ins, given_outs = outs;
    if (numbers.size() != ins * outs) {
      const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(numbers.size()))));
      if (n == 0 || n * n != numbers.size() || n > std::min(ins, outs) || filled_lines(block.data) != n) {
        faults_.add_at(block.line, fmt::format("{} values in {}", numbers.size(), block.side.name()), fmt::format("{} x {}", outs, ins));
        return;
      }
      given_ins = given_outs = n;
      out.unknown = ins * outs - n * n;
    }
    out.values.assign(ins * outs, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const std::size_t in = rows ? k / given_outs : k % given_ins, to = rows ? k % given_outs : k / given_ins;
      out.values[to * ins + in] = numbers[k];
    }
  }

  static std::size_t filled_lines(std::string_view data) {
    std::size_t lines = 0;
    bool filled = false;
    for (const char c : data) {
      if (c == '\n') lines += filled ? 1 : 0, filled = false;
      filled |= c != '\n' && c != '\r' && c != ' ' && c != '\t';
    }
    return lines + (filled ? 1 : 0);
  }

  const WindowDocument& document_;
  FaultList& faults_;
  std::size_t negative_ = 0;
};

const WindowBlock* find(const WindowDocument& document, const std::string& wavelength, const SheetSide& side) {
  const auto found = std::find_if(document.blocks.begin(), document.blocks.end(), [&](const WindowBlock& block) {
    return same_word_of_window(block.wavelength, wavelength) && block.side.kind == side.kind && block.side.front == side.front;
  });
  return found == document.blocks.end() ? nullptr : &*found;
}

bool is_colour(const std::string& wavelength) {
  for (const char* word : {"CIE-X", "CIE-Z", "CIE-u", "CIE-v"})
    if (same_word_of_window(wavelength, word)) return true;
  return false;
}

std::string names_of_blocks(const WindowDocument& document) {
  std::string out;
  for (const WindowBlock& block : document.blocks)
    out += fmt::format("{}{} of {}", out.empty() ? "" : ", ", block.side.name(), block.wavelength);
  return out;
}

/// One of two words, or nothing if the question is not answered.
std::optional<bool> answered(const ReadOptions& options, const char* key, const char* yes, const char* no) {
  const std::optional<std::string> answer = options.assumed(key);
  if (!answer) return std::nullopt;
  if (*answer != yes && *answer != no)
    throw Error(ErrorKind::usage, {fmt::format("--assume {}", key), excerpt(*answer), fmt::format("{} or {}", yes, no)});
  return *answer == yes;
}

struct Choice {
  const WindowBlock* block;
  bool by_default;
};

Choice choose(const WindowDocument& document, const ReadOptions& options, const std::string& file) {
  std::string wavelength = options.assumed("wavelength").value_or("");
  if (wavelength.empty()) {
    std::set<std::string> names;
    for (const WindowBlock& block : document.blocks) {
      if (same_word_of_window(block.wavelength, "Visible")) wavelength = block.wavelength;
      if (!is_colour(block.wavelength)) names.insert(block.wavelength);
    }
    if (wavelength.empty() && names.size() == 1) wavelength = *names.begin();
    if (wavelength.empty())
      throw Error(ErrorKind::input, {file, names_of_blocks(document), "Visible, or --assume wavelength=NAME with one of these"});
  }
  const std::optional<bool> transmission = answered(options, "kind", "transmission", "reflection"),
                            front = answered(options, "side", "front", "back");
  for (const Side kind : {Side::reflection, Side::transmission})
    for (const bool is_front : {false, true}) {
      if (transmission.value_or(kind == Side::transmission) != (kind == Side::transmission) || front.value_or(is_front) != is_front)
        continue;
      if (const WindowBlock* const block = find(document, wavelength, {kind, is_front})) return {block, !transmission && !front};
    }
  throw Error(ErrorKind::input, {file, names_of_blocks(document), fmt::format("a block of {} as --assume wants it", wavelength)});
}

/// The same block of another wavelength, if the file has both of a pair that make colour.
std::pair<const WindowBlock*, const WindowBlock*> colour_of(const WindowDocument& document, const WindowBlock& block, const char* first,
                                                            const char* second) {
  if (!same_word_of_window(block.wavelength, "Visible")) return {nullptr, nullptr};
  const WindowBlock *const a = find(document, first, block.side), *const b = find(document, second, block.side);
  return a && b ? std::pair(a, b) : std::pair<const WindowBlock*, const WindowBlock*>(nullptr, nullptr);
}

using Info = std::vector<std::pair<std::string, std::string>>;

void open_matrix(const WindowDocument& document, const Choice& choice, FaultList& faults, Opened& out) {
  BlockReader reader(document, faults);
  Matrix luminance, x, z;
  const auto [block_x, block_z] = colour_of(document, *choice.block, "CIE-X", "CIE-Z");
  for (const WindowBlock& block : document.blocks) {
    Matrix matrix = reader.matrix(block);
    if (&block == choice.block) luminance = std::move(matrix);
    if (&block == block_x) x = std::move(matrix);
    if (&block == block_z) z = std::move(matrix);
  }
  if (block_x && faults.empty())
    for (const Matrix* other : {&x, &z})
      if (other->incident != luminance.incident || other->outgoing != luminance.outgoing)
        faults.add_at(choice.block->line, "another basis than CIE-X or CIE-Z", "one basis for all three");
  faults.raise();

  std::vector<std::vector<double>> values;
  values.push_back(std::move(luminance.values));
  if (block_x) {
    values.resize(3);
    values[1].resize(values[0].size()), values[2].resize(values[0].size());
    for (std::size_t k = 0; k < values[0].size(); ++k) {
      const auto rgb = rgb_of_xyz({x.values[k], values[0][k], z.values[k]});
      for (std::size_t c = 0; c < 3; ++c) values[c][k] = rgb[c];
    }
  }
  const auto table = std::make_shared<const KlemsTable>(*luminance.incident, *luminance.outgoing, choice.block->side,
                                                        block_x ? rgb_channels() : single_channel("Y"), std::move(values));
  out.brdf = table;
  out.observations = std::make_shared<const LazyObservations>(table->channels(), table->symmetry(), [table] { return table->samples(); });
  out.masked.missing = luminance.unknown;
  out.info.emplace_back("nodes", fmt::format("means over {} x {} pairs of patches (out {}, in {})", table->outgoing().size(),
                                             table->incident().size(), table->outgoing().name(), table->incident().name()));
  if (luminance.unknown > 0) {
    out.info.emplace_back("unknown pairs", fmt::format("{}: the file holds the first patches only", luminance.unknown));
  } else {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (std::size_t in = 0; in < table->incident().size(); ++in) {
      const double sum = table->hemispherical(block_x ? 1 : 0, in);
      low = std::min(low, sum), high = std::max(high, sum);
    }
    out.info.emplace_back("hemispherical", fmt::format("{:.4g} to {:.4g} over the incident patches{}", low, high, block_x ? " (g)" : ""));
  }
  if (reader.negative() > 0) out.info.emplace_back("negative values", fmt::format("{}, read as 0 as Radiance does", reader.negative()));
}

void open_tree(const WindowDocument& document, const Choice& choice, FaultList& faults, Opened& out) {
  BlockReader reader(document, faults);
  std::optional<TensorTree> luminance, u, v;
  const auto [block_u, block_v] = colour_of(document, *choice.block, "CIE-u", "CIE-v");
  for (const WindowBlock& block : document.blocks) {
    std::optional<TensorTree> tree = reader.tree(block);
    if (&block == choice.block) luminance = std::move(tree);
    if (&block == block_u) u = std::move(tree);
    if (&block == block_v) v = std::move(tree);
  }
  faults.raise();
  const std::size_t leaves = luminance->leaf_count();
  const auto table =
      std::make_shared<const TensorTreeTable>(TreeChannels{std::move(*luminance), std::move(u), std::move(v)}, choice.block->side);
  out.brdf = table;
  out.observations = std::make_shared<const LazyObservations>(table->channels(), table->symmetry(), [table] { return table->samples(); });
  out.info.emplace_back("nodes", fmt::format("means over {} cells of a tensor tree of rank {}", leaves,
                                             document.structure == WindowStructure::tree3 ? 3 : 4));
  if (reader.negative() > 0) out.info.emplace_back("negative values", fmt::format("{}, read as 0 as Radiance does", reader.negative()));
}

}  // namespace

bool recognises_radiance_xml(std::string_view head, std::uintmax_t) { return head.find("<WindowElement") != std::string_view::npos; }

Opened open_radiance_xml(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const WindowDocument document = read_window_document(path, faults);
  const Choice choice = choose(document, options, path.string());
  Opened out;
  out.format = "radiance-xml";
  out.side = choice.block->side.kind;
  out.info = {{"holds", "f (BSDF), cosine not included"}, {"unit", "1/sr"}};
  const bool tree = document.structure == WindowStructure::tree3 || document.structure == WindowStructure::tree4;
  if (tree)
    open_tree(document, choice, faults, out);
  else
    open_matrix(document, choice, faults, out);

  Info& info = out.info;
  info.emplace_back("block", fmt::format("{} of {}{}", choice.block->side.name(), choice.block->wavelength,
                                         choice.by_default ? " (default; --assume kind, side, wavelength)" : ""));
  info.emplace_back("blocks", names_of_blocks(document));
  std::string missing;
  for (const Side kind : {Side::reflection, Side::transmission})
    for (const bool front : {true, false})
      if (!find(document, choice.block->wavelength, {kind, front}))
        missing += (missing.empty() ? "" : ", ") + SheetSide{kind, front}.name();
  info.emplace_back("missing blocks", missing.empty() ? "none" : missing);
  info.emplace_back("frame", choice.block->side.front ? "z out of the front, the sheet turned over its x axis (y of the file is -y)"
                                                      : "x, y of the file, z out of the back");
  info.emplace_back("channels", joined_names(out.brdf->channels()));
  if (out.brdf->channels().size() == 3)
    info.emplace_back(
        "colour", fmt::format("linear r, g, b of Radiance's primaries, from {}", tree ? "Visible, CIE-u, CIE-v" : "Visible, CIE-X, CIE-Z"));
  info.emplace_back("symmetry", words(out.brdf->symmetry()));
  if (!document.material.empty()) info.emplace_back("material", document.material);
  if (!document.manufacturer.empty()) info.emplace_back("manufacturer", document.manufacturer);
  return out;
}

}  // namespace gonio::tabulated
