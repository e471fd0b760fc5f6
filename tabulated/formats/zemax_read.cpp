// SPDX-License-Identifier: BSD-3-Clause
// Reading tabular scatter files of Zemax OpticStudio.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "data-schemas/document.hpp"
#include "tabulated/describe.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/keyword_text.hpp"
#include "tabulated/formats/zemax.hpp"
#include "tabulated/formats/zemax_set.hpp"
#include "tabulated/opened_samples.hpp"
#include "tabulated/total_scatter.hpp"

namespace gonio::tabulated {
namespace {

struct Header {
  SpecularGrid grid;
  Channels channels = single_channel("value");
  bool spectral_content = false, symmetry = false, scatter_type = false;
};

/// The values of a key word that has a few of them; their place in the list, or a fault.
std::optional<std::size_t> choice(KeywordText& text, std::string_view keyword, std::initializer_list<std::string_view> values,
                                  FaultList& faults) {
  const KeywordText::Word word = text.next();
  std::size_t k = 0;
  for (const std::string_view value : values) {
    if (same_word(word.text, value)) return k;
    ++k;
  }
  faults.add_at(word.line, fmt::format("{} {}", keyword, excerpt(word.text)), fmt::format("{}", fmt::join(values, ", ")));
  return std::nullopt;
}

Header read_header(KeywordText& text, FaultList& faults) {
  Header out;
  while (!text.at_end()) {
    if (same_word(text.peek().text, "Monochrome") || same_word(text.peek().text, "TristimulusX")) break;
    const KeywordText::Word word = text.next();
    if (same_word(word.text, "Source")) {
      text.next();
    } else if (same_word(word.text, "Symmetry")) {
      const auto symmetry = choice(text, word.text, {"PlaneSymmetrical", "Asymmetrical", "Asymmetrical4D"}, faults);
      out.grid.mirrored = symmetry == 0u;
      out.symmetry = true;
    } else if (same_word(word.text, "SpectralContent")) {
      if (choice(text, word.text, {"Monochrome", "XYZ"}, faults) == 1u) {
        out.channels.resize(3);
        out.channels[0].name = "X", out.channels[1].name = "Y", out.channels[2].name = "Z";
      }
      out.spectral_content = true;
    } else if (same_word(word.text, "ScatterType")) {
      if (choice(text, word.text, {"BRDF", "BTDF"}, faults) == 1u) out.grid.side = Side::transmission;
      out.scatter_type = true;
    } else if (same_word(word.text, "SampleRotation")) {
      out.grid.rotation_deg = text.counted_list("sample rotations");
    } else if (same_word(word.text, "AngleOfIncidence")) {
      out.grid.incidence_deg = text.counted_list("angles of incidence");
    } else if (same_word(word.text, "ScatterAzimuth")) {
      out.grid.azimuth_deg = text.counted_list("azimuths");
    } else if (same_word(word.text, "ScatterRadial")) {
      out.grid.radial_deg = text.counted_list("radial angles");
    } else {
      faults.add_at(word.line, excerpt(word.text), "a key word of a Zemax scatter file");
      return out;
    }
    if (!faults.empty()) return out;
  }
  if (out.grid.rotation_deg.empty()) out.grid.rotation_deg = {0};
  return out;
}

void require_header(const Header& header, FaultList& faults) {
  const auto present = [&](bool is, const char* keyword) {
    if (!is) faults.add(faults.file(), fmt::format("no {}", keyword), "a header with all its key words");
  };
  const SpecularGrid& grid = header.grid;
  present(header.symmetry, "Symmetry");
  present(header.spectral_content, "SpectralContent");
  present(header.scatter_type, "ScatterType");
  present(!grid.incidence_deg.empty(), "AngleOfIncidence");
  present(!grid.azimuth_deg.empty(), "ScatterAzimuth");
  present(!grid.radial_deg.empty(), "ScatterRadial");
  require_angles(grid.rotation_deg, "SampleRotation", -360, 360, faults);
  require_angles(grid.incidence_deg, "AngleOfIncidence", 0, 90, faults);
  require_angles(grid.azimuth_deg, "ScatterAzimuth", 0, grid.mirrored ? 180 : 360, faults);
  require_angles(grid.radial_deg, "ScatterRadial", 0, 180, faults);
}

/// The blocks of one channel: TIS and values per rotation and incidence. Stops at the first fault.
void read_channel(KeywordText& text, const SpecularGrid& grid, std::vector<double>& values, std::vector<double>& tis, FaultList& faults) {
  text.take("DataBegin");
  const std::size_t block = grid.azimuth_deg.size() * grid.radial_deg.size();
  for (std::size_t k = 0; k < grid.rotation_deg.size() * grid.incidence_deg.size(); ++k) {
    if (!text.take("TIS")) {
      faults.add_at(text.peek().line, text.at_end() ? "the end of the file" : excerpt(text.peek().text),
                    fmt::format("TIS of block {} of {}", k + 1, grid.rotation_deg.size() * grid.incidence_deg.size()));
      return;
    }
    const std::optional<double> total = text.number("TIS");
    if (!total) return;
    tis.push_back(*total);
    for (std::size_t n = 0; n < block; ++n) {
      const std::optional<double> value = text.number("a value in 1/sr");
      if (!value) return;
      values.push_back(*value);
    }
  }
}

RotationSense rotation_sense(const KeywordText& text, const SpecularGrid& grid, const ReadOptions& options, FaultList& faults) {
  if (grid.rotation_deg.size() == 1) return RotationSense::counter_clockwise;
  for (const std::string& comment : text.comments())
    if (comment == zemax_rotation_comment) return RotationSense::counter_clockwise;
  const std::optional<std::string> answer = options.assumed("rotation");
  if (answer == "counter-clockwise") return RotationSense::counter_clockwise;
  if (answer == "clockwise") return RotationSense::clockwise;
  faults.add(faults.file(), answer ? fmt::format("--assume rotation={}", *answer) : "sample rotations without their sense",
             "--assume rotation=counter-clockwise or rotation=clockwise");
  return RotationSense::counter_clockwise;
}

/// The wavelength as our writer and Ansys' converter from SPEOS put it into a comment.
std::optional<double> wavelength_comment(const KeywordText& text) {
  for (const std::string& comment : text.comments()) {
    const std::size_t at = comment.find(zemax_wavelength_comment);
    if (at == std::string::npos) continue;
    const Number number = parse_number(std::string_view(comment).substr(at + zemax_wavelength_comment.size()));
    if (number.fault == nullptr && number.value > 0) return number.value;
  }
  return std::nullopt;
}

std::string tis_words(const std::vector<double>& tis, const SpecularGrid& grid) {
  std::string out;
  for (std::size_t i = 0; i < grid.incidence_deg.size(); ++i)
    out += fmt::format("{}{:.6g} at {} deg", i == 0 ? "" : ", ", tis[i], grid.incidence_deg[i]);
  return out;
}

}  // namespace

std::shared_ptr<const ZemaxTable> read_zemax(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const std::string content = read_file(path);
  KeywordText text(content, faults);
  Header header = read_header(text, faults);
  faults.raise();
  require_header(header, faults);
  header.grid.sense = rotation_sense(text, header.grid, options, faults);
  if (const auto wavelength = options.assumed("wavelength_nm")) {
    const Number number = parse_number(*wavelength);
    if (number.fault != nullptr || !(number.value > 0) || header.channels.size() > 1)
      faults.add(faults.file(), fmt::format("--assume wavelength_nm={}", *wavelength), "a positive number, for a file of one channel");
    header.channels.front().wavelength_in_nm = number.value;
  }
  if (header.channels.size() == 1 && !header.channels[0].wavelength_in_nm) header.channels[0].wavelength_in_nm = wavelength_comment(text);
  faults.raise();
  // Every list fits the file, so no product of four of them overflows 64 bits for files below 200 kB; compare in double before.
  const SpecularGrid& grid = header.grid;
  const double nodes = static_cast<double>(grid.rotation_deg.size()) * static_cast<double>(grid.incidence_deg.size()) *
                       static_cast<double>(grid.azimuth_deg.size()) * static_cast<double>(grid.radial_deg.size());
  if (nodes * static_cast<double>(header.channels.size()) > static_cast<double>(content.size()))
    throw Error(ErrorKind::input, {path.string(), fmt::format("a grid of {:.0f} values in {} bytes", nodes, content.size()),
                                   "a file as long as its header says"});

  ZemaxRemarks remarks;
  std::vector<std::vector<double>> values(header.channels.size());
  remarks.tis.resize(header.channels.size());
  constexpr std::string_view blocks[] = {"TristimulusX", "TristimulusY", "TristimulusZ"};
  for (std::size_t c = 0; c < header.channels.size() && faults.empty(); ++c) {
    const std::string_view block = header.channels.size() == 1 ? std::string_view("Monochrome") : blocks[c];
    if (!text.take(block)) {
      faults.add_at(text.peek().line, text.at_end() ? "the end of the file" : excerpt(text.peek().text), std::string(block));
      break;
    }
    read_channel(text, grid, values[c], remarks.tis[c], faults);
    const bool last = c + 1 == header.channels.size();
    if (faults.empty() && !text.take("DataEnd") && last)
      faults.add_at(text.peek().line, text.at_end() ? "the end of the file" : excerpt(text.peek().text), "DataEnd");
  }
  if (faults.empty() && !text.at_end()) faults.add_at(text.peek().line, excerpt(text.peek().text), "the end of the file");
  faults.raise();
  remarks.comments = text.comments();
  return std::make_shared<const ZemaxTable>(std::move(header.grid), std::move(header.channels), std::move(values), std::move(remarks));
}

bool recognises_zemax(std::string_view head, std::uintmax_t) {
  return has_keyword_line(head, "AngleOfIncidence") && has_keyword_line(head, "ScatterType") && has_keyword_line(head, "SpectralContent");
}

Opened open_zemax(const std::filesystem::path& path, const ReadOptions& options) {
  std::vector<std::string> missing;
  const auto table = whole_zemax_set(read_zemax(path, options), path, options, missing);
  const SpecularGrid& grid = table->grid();
  const ZemaxRemarks& remarks = table->remarks();
  Dataset samples = table->samples();
  if (samples.size() == 0) throw Error(ErrorKind::input, {path.string(), "no node above the horizon", "at least one"});
  samples.provenance["source"] = path.filename().string();
  std::string comments;
  for (const std::string& comment : remarks.comments) comments += (comments.empty() ? "" : "\n") + comment;
  if (!comments.empty()) samples.provenance["comments"] = comments;
  for (std::size_t c = 0; c < remarks.tis.size(); ++c) {
    std::string list;
    for (const double tis : remarks.tis[c]) {
      if (!list.empty()) list += ' ';
      append_number(list, tis);
    }
    samples.provenance[fmt::format("zemax_tis_{}", table->channels()[c].name)] = list;
  }
  Opened out = opened_samples("zemax", std::make_shared<const Dataset>(std::move(samples)));
  std::vector<double> ours;
  for (const double incidence : grid.incidence_deg) {
    const Angle phi_i = grid.angles(0, 0, 0, 0).phi_i;
    ours.push_back(total_scatter(*table, degrees(incidence), phi_i, grid.side).front());
  }
  out.info.insert(
      out.info.begin(),
      {{"holds", "f, cosine not included"},
       {"unit", "1/sr"},
       {"nodes", fmt::format("{} rotations x {} incidences x {} azimuths x {} radial angles about the specular direction",
                             grid.rotation_deg.size(), grid.incidence_deg.size(), grid.azimuth_deg.size(), grid.radial_deg.size())},
       {"TIS of the file", tis_words(remarks.tis.front(), grid)},
       {"integral of f cos theta_o", tis_words(ours, grid)}});
  if (!missing.empty())
    out.info.emplace_back("missing", fmt::format("the other channels of the set: no {} beside this file", fmt::join(missing, ", ")));
  out.brdf = table;
  return out;
}

}  // namespace gonio::tabulated
