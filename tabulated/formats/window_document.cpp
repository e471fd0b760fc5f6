// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/window_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <utility>

#include "tabulated/mapped_file.hpp"

namespace gonio::tabulated {
namespace {

/// Of one basis: more rings or patches than any measurement has, few enough for a matrix to fit into memory.
constexpr std::size_t max_rings = 64, max_patches = 4096;

/// The file and its tree.
struct Parsed {
  explicit Parsed(const std::filesystem::path& path) : file(path) {}
  MappedFile file;
  pugi::xml_document document;
};

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

class DocumentReader {
 public:
  DocumentReader(WindowDocument& out, FaultList& faults) : out_(out), faults_(faults) {}

  void read(const pugi::xml_node& root) {
    const pugi::xml_node layer = root.child("Optical").child("Layer");
    if (!layer) {
      add(root, "no Optical/Layer", "the layer with the data");
      return;
    }
    if (layer.next_sibling("Layer")) add(layer, "several layers", "one");
    out_.material = text_of(layer.child("Material"), "Name");
    out_.manufacturer = text_of(layer.child("Material"), "Manufacturer");
    read_definition(layer);
    for (pugi::xml_node data = layer.child("WavelengthData"); data; data = data.next_sibling("WavelengthData")) {
      const std::string wavelength = text_of(data, "Wavelength");
      if (wavelength.empty()) add(data, "no Wavelength", "Visible, CIE-X, ... ");
      if (!data.child("WavelengthDataBlock")) add(data, "no WavelengthDataBlock", "at least one");
      for (pugi::xml_node block = data.child("WavelengthDataBlock"); block; block = block.next_sibling("WavelengthDataBlock"))
        read_block(block, wavelength);
    }
    if (out_.blocks.empty()) add(layer, "no WavelengthDataBlock", "at least one");
  }

 private:
  std::size_t line_of(const pugi::xml_node& node) const {
    const std::ptrdiff_t offset = node.offset_debug();
    return offset < 0 ? 1 : line_at(out_.text, static_cast<std::size_t>(offset));
  }
  void add(const pugi::xml_node& node, std::string found, std::string wanted) {
    faults_.add_at(line_of(node), fmt::format("{} in <{}>", found, excerpt(node.name())), std::move(wanted));
  }
  static std::string text_of(const pugi::xml_node& parent, const char* name) { return std::string(trimmed(parent.child_value(name))); }

  double number_of(const pugi::xml_node& parent, const char* name) {
    const std::string text = text_of(parent, name);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
    add(parent, fmt::format("{} {}", name, excerpt(text)), "a number");
    return std::nan("");
  }

  void read_definition(const pugi::xml_node& layer) {
    const pugi::xml_node definition = layer.child("DataDefinition");
    const std::string structure = text_of(definition, "IncidentDataStructure");
    constexpr std::pair<const char*, WindowStructure> known[] = {{"Columns", WindowStructure::columns},
                                                                 {"Rows", WindowStructure::rows},
                                                                 {"TensorTree3", WindowStructure::tree3},
                                                                 {"TensorTree4", WindowStructure::tree4}};
    const auto found =
        std::find_if(std::begin(known), std::end(known), [&](const auto& k) { return same_word_of_window(structure, k.first); });
    if (found == std::end(known))
      add(definition ? definition : layer, fmt::format("IncidentDataStructure {}", excerpt(structure)),
          "Columns, Rows, TensorTree3 or TensorTree4");
    else
      out_.structure = found->second;
    for (pugi::xml_node basis = definition.child("AngleBasis"); basis; basis = basis.next_sibling("AngleBasis")) read_basis(basis);
  }

  void read_basis(const pugi::xml_node& node) {
    const std::string name = text_of(node, "AngleBasisName");
    if (!node.child("AngleBasisBlock")) return;  // a name alone refers to a standard basis
    if (name.empty()) add(node, "no AngleBasisName", "a name to refer to");
    std::vector<PatchRing> rings;
    std::size_t patches = 0;
    for (pugi::xml_node block = node.child("AngleBasisBlock"); block; block = block.next_sibling("AngleBasisBlock")) {
      const pugi::xml_node bounds = block.child("ThetaBounds");
      const double lower = number_of(bounds ? bounds : block, "LowerTheta"), upper = number_of(bounds ? bounds : block, "UpperTheta");
      const double count = number_of(block, "nPhis");
      if (std::isnan(lower) || std::isnan(upper) || std::isnan(count)) return;
      const double last = rings.empty() ? 0 : rings.back().upper_deg;
      if (std::fabs(lower - last) > 1e-6 * last || !(upper > lower) || upper > 90) {
        add(block, fmt::format("ThetaBounds {} to {}", lower, upper), fmt::format("bounds from {} to at most 90", last));
        return;
      }
      if (!(count >= 1) || count != std::floor(count) || static_cast<double>(patches) + count > max_patches || rings.size() == max_rings ||
          (count == 1 && last > 0)) {
        add(block, fmt::format("nPhis {}", count),
            fmt::format("a number of sectors, 1 only around the normal; at most {} rings and {} patches", max_rings, max_patches));
        return;
      }
      rings.push_back({last, upper, static_cast<std::size_t>(count)});
      patches += rings.back().patches;
    }
    const KlemsBasis* const standard = KlemsBasis::standard(name);
    if (standard && standard->rings() != rings)
      add(node, fmt::format("{} defined otherwise than it is", excerpt(name)), "its own rings, or another name");
    else if (!standard && out_.basis(name))
      add(node, fmt::format("{} once more", excerpt(name)), "one definition");
    else if (!standard)
      out_.bases.emplace_back(name, std::move(rings));
  }

  void read_block(const pugi::xml_node& node, const std::string& wavelength) {
    WindowBlock block;
    block.wavelength = wavelength;
    block.line = line_of(node);
    const std::string direction = text_of(node, "WavelengthDataDirection");
    bool known = false;
    for (const Side kind : {Side::reflection, Side::transmission})
      for (const bool front : {true, false})
        if (const SheetSide side{kind, front}; same_word_of_window(direction, side.name())) block.side = side, known = true;
    if (!known) add(node, fmt::format("WavelengthDataDirection {}", excerpt(direction)), "Reflection or Transmission, Front or Back");
    for (const WindowBlock& other : out_.blocks)
      if (known && same_word_of_window(other.wavelength, wavelength) && other.side.name() == block.side.name())
        add(node, fmt::format("{} of {} once more", block.side.name(), excerpt(wavelength)), "each direction once");
    const std::string type = text_of(node, "ScatteringDataType");
    constexpr const char* types[] = {"", "BTDF", "BRDF", "BSDF"};
    if (std::none_of(std::begin(types), std::end(types), [&](const char* word) { return same_word_of_window(type, word); }))
      add(node, fmt::format("ScatteringDataType {}", excerpt(type)), "BTDF, BRDF or BSDF: values in 1/sr without a cosine");
    block.column_basis = text_of(node, "ColumnAngleBasis");
    block.row_basis = text_of(node, "RowAngleBasis");
    block.basis = text_of(node, "AngleBasis");
    const pugi::xml_node data = node.child("ScatteringData"), numbers = data.first_child();
    if (!numbers || numbers.type() != pugi::node_pcdata || numbers.next_sibling()) {
      add(node, data ? "ScatteringData that is no plain text" : "no ScatteringData", "numbers");
      return;
    }
    block.data = numbers.value();
    block.data_offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, numbers.offset_debug()));
    if (known) out_.blocks.push_back(std::move(block));
  }

  WindowDocument& out_;
  FaultList& faults_;
};

}  // namespace

bool same_word_of_window(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::size_t line_at(std::string_view text, std::size_t offset) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n'));
}

const KlemsBasis* WindowDocument::basis(const std::string& name) const {
  for (const KlemsBasis& basis : bases)
    if (same_word_of_window(basis.name(), name)) return &basis;
  return KlemsBasis::standard(name);
}

WindowDocument read_window_document(const std::filesystem::path& path, FaultList& faults) {
  const auto parsed = std::make_shared<Parsed>(path);
  const auto bytes = parsed->file.bytes();
  WindowDocument out;
  out.text = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  if (out.text.size() > max_window_file)
    faults.add(path.string(), fmt::format("{} bytes", out.text.size()), fmt::format("at most {}", max_window_file));
  if (const auto elements = static_cast<std::size_t>(std::count(out.text.begin(), out.text.end(), '<')); elements > max_window_elements)
    faults.add(path.string(), fmt::format("{} tags", elements), fmt::format("at most {}", max_window_elements));
  if (const std::size_t at = std::min(out.text.find("<!DOCTYPE"), out.text.find("<!ENTITY")); at != std::string_view::npos)
    faults.add_at(line_at(out.text, at), "a document type", "a file without one: it could define entities");
  if (const std::size_t at = out.text.find('\0'); at != std::string_view::npos)
    faults.add_at(line_at(out.text, at), fmt::format("a NUL byte at offset {}", at), "text");
  faults.raise();

  // Without conversion of line ends, so that offsets into texts are offsets into the file.
  constexpr unsigned flags = pugi::parse_cdata | pugi::parse_escapes;
  const pugi::xml_parse_result result = parsed->document.load_buffer(bytes.data(), bytes.size(), flags, pugi::encoding_utf8);
  if (!result) {
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, result.offset));
    faults.add_at(line_at(out.text, offset), fmt::format("{} at byte {}", result.description(), offset), "well-formed XML");
    faults.raise();
  }
  const pugi::xml_node root = parsed->document.document_element();
  if (!same_word_of_window(root.name(), "WindowElement"))
    faults.add_at(1, fmt::format("<{}>", excerpt(root.name())), "<WindowElement>");
  else
    DocumentReader(out, faults).read(root);
  faults.raise();
  out.owner = parsed;
  return out;
}

}  // namespace gonio::tabulated
