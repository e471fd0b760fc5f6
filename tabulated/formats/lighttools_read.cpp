// SPDX-License-Identifier: BSD-3-Clause
// Reading tabular scatter files of LightTools.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/keyword_text.hpp"
#include "tabulated/formats/lighttools.hpp"
#include "tabulated/formats/polar_block.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr double phi_i_deg = 90;

struct Block {
  std::size_t line = 0;
  double aoi = 0, poi = 0, wavelength = 0, tis = 0;
  bool back = false, transmission = false;
  int tristimulus = -1;
  std::vector<double> values;  ///< azimuth rows of radial values
};

struct Content {
  bool mirrored = false, xyz = false;
  std::vector<double> azimuth_deg, radial_deg;
  std::vector<Block> blocks;
};

std::optional<std::size_t> word_of(KeywordText& text, std::string_view keyword, std::initializer_list<std::string_view> values,
                                   FaultList& faults) {
  const KeywordText::Word word = text.next();
  const auto found = std::find_if(values.begin(), values.end(), [&](std::string_view value) { return same_word(word.text, value); });
  if (found != values.end()) return static_cast<std::size_t>(found - values.begin());
  faults.add_at(word.line, fmt::format("{} {}", keyword, excerpt(word.text)), fmt::format("{}", fmt::join(values, ", ")));
  return std::nullopt;
}

void read_header(KeywordText& text, Content& out, FaultList& faults) {
  bool symmetry = false, spectral_content = false;
  while (faults.empty() && !text.take("DataBegin")) {
    const KeywordText::Word word = text.next();
    if (same_word(word.text, "Symmetry")) {
      out.mirrored = word_of(text, word.text, {"PlaneSymmetrical", "Asymmetric", "Asymmetrical"}, faults) == 0u;
      symmetry = true;
    } else if (same_word(word.text, "SpectralContent")) {
      out.xyz = word_of(text, word.text, {"Monochrome", "XYZ"}, faults) == 1u;
      spectral_content = true;
    } else if (same_word(word.text, "ScatterAzimuth")) {
      out.azimuth_deg = text.counted_list("azimuths");
    } else if (same_word(word.text, "ScatterRadial")) {
      out.radial_deg = text.counted_list("radial angles");
    } else if (same_word(word.text, "Source")) {
      text.next();
    } else {
      faults.add_at(word.line, word.text.empty() ? "the end of the file" : excerpt(word.text), "a key word of a LightTools scatter file");
    }
  }
  if (!faults.empty()) return;
  const auto present = [&](bool is, const char* keyword) {
    if (!is) faults.add(faults.file(), fmt::format("no {}", keyword), "a header with all its key words");
  };
  present(symmetry, "Symmetry");
  present(spectral_content, "SpectralContent");
  present(!out.azimuth_deg.empty(), "ScatterAzimuth");
  present(!out.radial_deg.empty(), "ScatterRadial");
  require_angles(out.azimuth_deg, "ScatterAzimuth", -360, 360, faults);
  require_angles(out.radial_deg, "ScatterRadial", 0, 180, faults);
}

/// One block up to the last of its values. Stops at the first fault.
Block read_block(KeywordText& text, const Content& content, FaultList& faults) {
  Block out;
  out.line = text.peek().line;
  const auto number = [&](const char* what) { return text.number(what).value_or(0); };
  while (faults.empty()) {
    const KeywordText::Word word = text.next();
    if (same_word(word.text, "AOI")) {
      out.aoi = number("an angle of incidence");
    } else if (same_word(word.text, "POI")) {
      out.poi = number("a plane of incidence");
    } else if (same_word(word.text, "Side")) {
      out.back = word_of(text, word.text, {"Front", "Back"}, faults) == 1u;
    } else if (same_word(word.text, "Wavelength")) {
      out.wavelength = number("a wavelength");
    } else if (same_word(word.text, "ScatterType")) {
      out.transmission = word_of(text, word.text, {"BRDF", "BTDF"}, faults) == 1u;
    } else if (same_word(word.text, "TristimulusValue")) {
      out.tristimulus = static_cast<int>(word_of(text, word.text, {"TrisX", "TrisY", "TrisZ"}, faults).value_or(0));
    } else if (same_word(word.text, "TIS")) {
      out.tis = number("TIS");
      const std::size_t count = content.azimuth_deg.size() * content.radial_deg.size();
      if (faults.empty() && !text.can_hold(count)) faults.add_at(word.line, "fewer values than the header promises", "one per direction");
      for (std::size_t k = 0; k < count && faults.empty(); ++k) out.values.push_back(number("a value in 1/sr"));
      break;
    } else {
      faults.add_at(word.line, word.text.empty() ? "the end of the file" : excerpt(word.text), "a key word of a block, or DataEnd");
    }
  }
  // The back is lit from below: normal incidence there is written as 180.
  if (out.back && out.aoi > 90) out.aoi = 180 - out.aoi;
  if (faults.empty() && !(out.aoi >= 0 && out.aoi <= 90)) faults.add_at(out.line, fmt::format("AOI {}", out.aoi), "0 to 90 degrees");
  if (faults.empty() && out.wavelength < 0) faults.add_at(out.line, fmt::format("Wavelength {}", out.wavelength), "a wavelength in nm");
  if (faults.empty() && content.xyz != (out.tristimulus >= 0))
    faults.add_at(out.line, content.xyz ? "a block without TristimulusValue" : "a TristimulusValue in a monochrome file",
                  "blocks as SpectralContent says");
  return out;
}

/// Keeps the blocks of one side and one kind of scatter.
void choose(std::vector<Block>& blocks, const ReadOptions& options, FaultList& faults) {
  const auto choose_by = [&](bool Block::*member, const char* key, const char* no, const char* yes) {
    const std::optional<std::string> answer = options.assumed(key);
    if (answer && *answer != no && *answer != yes) {
      faults.add(faults.file(), fmt::format("--assume {}={}", key, *answer), fmt::format("{} or {}", no, yes));
      return;
    }
    const bool both =
        std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) { return block.*member != blocks.front().*member; });
    if (!both && !answer) return;
    if (!answer) {
      faults.add(faults.file(), fmt::format("blocks of {} and of {}", no, yes), fmt::format("--assume {}={} or {}", key, no, yes));
      return;
    }
    std::erase_if(blocks, [&](const Block& block) { return block.*member != (*answer == yes); });
    if (blocks.empty()) faults.add(faults.file(), fmt::format("no block of {}", *answer), fmt::format("another --assume {}", key));
  };
  if (!blocks.empty()) choose_by(&Block::back, "side", "front", "back");
  if (!blocks.empty() && faults.empty()) choose_by(&Block::transmission, "scatter", "BRDF", "BTDF");
  if (blocks.empty() && faults.empty()) faults.add(faults.file(), "no block", "at least one incidence");
}

Channels channels_of(const std::vector<Block>& blocks, bool xyz, std::map<double, std::size_t>& by_wavelength) {
  Channels out;
  if (xyz) {
    out.resize(3);
    for (std::size_t c = 0; c < 3; ++c) out[c].name = std::string(1, "XYZ"[c]);
    return out;
  }
  for (const Block& block : blocks) by_wavelength.emplace(block.wavelength, 0);
  for (auto& [wavelength, place] : by_wavelength) {
    place = out.size();
    out.push_back(single_channel(by_wavelength.size() == 1 ? "value" : fmt::format("{}nm", wavelength)).front());
    if (wavelength > 0) out.back().wavelength_in_nm = out.back().wavelength_out_nm = wavelength;
  }
  return out;
}

}  // namespace

Dataset read_lighttools(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const std::string bytes = read_file(path);
  KeywordText text(bytes, faults);
  Content content;
  read_header(text, content, faults);
  faults.raise();
  while (faults.empty() && !text.take("DataEnd")) content.blocks.push_back(read_block(text, content, faults));
  faults.raise();
  choose(content.blocks, options, faults);
  faults.raise();
  for (const Block& block : content.blocks)
    if (block.poi != content.blocks.front().poi)
      faults.add_at(block.line, fmt::format("POI {} after {}", block.poi, content.blocks.front().poi),
                    "one plane of incidence: how several turn is not known");

  Dataset out;
  std::map<double, std::size_t> by_wavelength;
  out.channels = channels_of(content.blocks, content.xyz, by_wavelength);
  out.side = content.blocks.front().transmission ? Side::transmission : Side::reflection;
  out.symmetry = {true, content.mirrored, false};
  std::map<double, std::vector<const Block*>> by_incidence;
  for (const Block& block : content.blocks) {
    auto& channels = by_incidence[block.aoi];
    channels.resize(out.channels.size());
    const std::size_t c = content.xyz ? static_cast<std::size_t>(block.tristimulus) : by_wavelength.at(block.wavelength);
    if (channels[c] != nullptr) faults.add_at(block.line, fmt::format("AOI {} a second time", block.aoi), "every incidence once");
    channels[c] = &block;
  }
  std::string tis;
  for (const auto& [aoi, channels] : by_incidence) {
    PolarBlock block{degrees(aoi), degrees(phi_i_deg), 0_deg, content.radial_deg, content.azimuth_deg, {}};
    if (out.side == Side::transmission)
      for (double& theta : block.theta_deg) theta = 180 - theta;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (channels[c] == nullptr) {
        faults.add(faults.file(), fmt::format("AOI {} without {}", aoi, out.channels[c].name), "every channel at every incidence");
        continue;
      }
      std::vector<double>& values = block.values.emplace_back();
      for (std::size_t r = 0; r < content.radial_deg.size(); ++r)
        for (std::size_t a = 0; a < content.azimuth_deg.size(); ++a)
          values.push_back(channels[c]->values[a * content.radial_deg.size() + r]);
      tis += fmt::format("{}{}", tis.empty() ? "" : " ", channels[c]->tis);
    }
    if (faults.empty()) append_samples(block, out);
  }
  faults.raise();
  if (out.size() == 0) throw Error(ErrorKind::input, {path.string(), "no direction above the horizon", "at least one"});
  out.provenance = {{"source", path.filename().string()}, {"lighttools_tis", tis}};
  return out;
}

bool recognises_lighttools(std::string_view head, std::uintmax_t) {
  return has_keyword_line(head, "ScatterRadial") && has_keyword_line(head, "ScatterAzimuth") && has_keyword_line(head, "SpectralContent") &&
         !has_keyword_line(head, "AngleOfIncidence");
}

Opened open_lighttools(const std::filesystem::path& path, const ReadOptions& options) {
  Opened out = opened_grid("lighttools", std::make_shared<const Dataset>(read_lighttools(path, options)));
  out.info.insert(
      out.info.begin(),
      {{"holds", "f, cosine not included"}, {"unit", "1/sr"}, {"nodes", "at samples; absolute angles, the light at azimuth 90 deg"}});
  return out;
}

}  // namespace gonio::tabulated
