// SPDX-License-Identifier: BSD-3-Clause
// Reading scatter files of Ansys SPEOS.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/keyword_text.hpp"
#include "tabulated/formats/polar_block.hpp"
#include "tabulated/formats/speos.hpp"
#include "tabulated/polar_integral.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr std::string_view isotropic_title = "OPTIS - brdf surface file v", anisotropic_title = "OPTIS - Anisotropic BSDF surface file v";

/// What stands before the numbers.
struct Preamble {
  bool anisotropic = false;
  std::string comment;
  std::size_t end = 0, lines = 0;  ///< position and number of the first line after it
};

Preamble read_preamble(std::string_view bytes, FaultList& faults) {
  Preamble out;
  std::size_t at = 0, line = 0;
  const auto next = [&] {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    std::string_view text = bytes.substr(at, end - at);
    at = std::min(end + 1, bytes.size());
    ++line;
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  };
  const std::string_view title = next();
  out.anisotropic = title.starts_with(anisotropic_title);
  const std::string_view start = out.anisotropic ? anisotropic_title : isotropic_title;
  const Number version = title.starts_with(start) ? parse_number(title.substr(start.size())) : Number{0, "no version"};
  if (version.fault != nullptr || !(version.value >= 8 && version.value < 10))
    faults.add_at(line, excerpt(title), "a SPEOS scatter file of version 8 or 9");
  const std::string_view mode = next();
  if (mode != "0")
    faults.add_at(line, fmt::format("mode {}", excerpt(mode)), "0: text (open and save a binary file as text in SPEOS' viewer)");
  out.comment = std::string(next());
  const std::string_view length_text = next();
  const Number length = parse_number(length_text);
  if (length.fault != nullptr || !(length.value >= 0 && length.value <= static_cast<double>(bytes.size() - at)))
    faults.add_at(line, excerpt(length_text), "the number of characters of the description");
  if (!faults.empty()) return out;
  const std::string_view description = bytes.substr(at, static_cast<std::size_t>(length.value));
  line += static_cast<std::size_t>(std::count(description.begin(), description.end(), '\n'));
  at += description.size();
  next();
  out.end = at;
  out.lines = line;
  return out;
}

struct Table {
  double rotation_deg = 0, incidence_deg = 0, percentage = 0;
  std::size_t line = 0;
  bool transmission = false;
  PolarBlock block;  ///< one channel
};

/// `nTheta nPhi`, the azimuths, then rows that start with their zenith angle.
void read_table(KeywordText& text, bool intensity, Table& out, FaultList& faults) {
  out.line = text.peek().line;
  const std::size_t thetas = text.count("zenith angles");
  const std::size_t azimuths = faults.empty() ? text.count("azimuths") : 0;
  if (!faults.empty()) return;
  out.block.phi_deg = text.list(azimuths, "an azimuth in degrees");
  auto& values = out.block.values.emplace_back();
  for (std::size_t t = 0; t < thetas && faults.empty(); ++t) {
    const double theta = text.number("a zenith angle in degrees").value_or(0);
    const std::vector<double> row = faults.empty() ? text.list(azimuths, "a value") : std::vector<double>();
    out.block.theta_deg.push_back(theta);
    // Intensity at the horizon says nothing about f.
    constexpr double vanishing_cosine = 1e-6;
    const double cosine = std::fabs(degrees(theta).cos());
    for (const double value : row) values.push_back(!intensity ? value : cosine < vanishing_cosine ? 0 : value / cosine);
  }
  if (!faults.empty()) return;
  require_angles(out.block.theta_deg, "theta", 0, 180, faults);
  require_angles(out.block.phi_deg, "phi", 0, 360, faults);
}

bool flag(KeywordText& text, const char* what, FaultList& faults) {
  const std::size_t line = text.peek().line;
  const double value = text.number(what).value_or(0);
  if (faults.empty() && value != 0 && value != 1) faults.add_at(line, fmt::format("{} {}", what, value), "0 or 1");
  return value == 1;
}

struct Content {
  Channels channels;
  std::vector<Table> tables;  ///< by side, rotation, incidence and, fastest, wavelength
  std::string spectrum;
};

Content read_isotropic(KeywordText& text, FaultList& faults) {
  Content out;
  const bool reflection = flag(text, "the flag of reflection", faults),
             transmission = faults.empty() && flag(text, "the flag of transmission", faults);
  const bool bsdf = faults.empty() && flag(text, "the flag of BSDF values", faults);
  const std::size_t incidences = faults.empty() ? text.count("incidences") : 0,
                    wavelengths = faults.empty() ? text.count("wavelengths") : 0;
  if (!faults.empty()) return out;
  const std::vector<double> incidence_deg = text.list(incidences, "an incidence in degrees");
  const std::vector<double> nm = faults.empty() ? text.list(wavelengths, "a wavelength in nm") : std::vector<double>();
  if (!faults.empty()) return out;
  require_angles(incidence_deg, "incidence", 0, 90, faults);
  for (std::size_t k = 0; k < nm.size(); ++k) {
    if (!(nm[k] > 0) || (k > 0 && !(nm[k] > nm[k - 1])))
      faults.add(faults.file(), fmt::format("wavelength {}", nm[k]), "increasing positive wavelengths");
    out.channels.push_back(single_channel(nm.size() == 1 ? "value" : fmt::format("{}nm", nm[k])).front());
    out.channels.back().wavelength_in_nm = out.channels.back().wavelength_out_nm = nm[k];
  }
  for (const bool through : {false, true})
    for (std::size_t i = 0; i < incidences && (through ? transmission : reflection); ++i)
      for (std::size_t w = 0; w < wavelengths && faults.empty(); ++w) {
        Table& table = out.tables.emplace_back();
        table.incidence_deg = incidence_deg[i];
        table.transmission = through;
        table.percentage = text.number("a percentage").value_or(0);
        if (faults.empty()) read_table(text, !bsdf, table, faults);
      }
  return out;
}

Content read_anisotropic(KeywordText& text, FaultList& faults) {
  Content out;
  out.channels = single_channel("value");
  text.list(3, "the anisotropy vector");
  const bool reflection = faults.empty() && flag(text, "the flag of reflection", faults),
             transmission = faults.empty() && flag(text, "the flag of transmission", faults);
  const bool bsdf = faults.empty() && flag(text, "the flag of BSDF values", faults);
  for (const bool through : {false, true}) {
    if (!(through ? transmission : reflection) || !faults.empty()) continue;
    const std::vector<double> rotations = text.counted_list("anisotropy angles");
    if (faults.empty()) require_angles(rotations, "anisotropy angle", 0, 360, faults);
    for (std::size_t r = 0; r < rotations.size() && faults.empty(); ++r) {
      const std::vector<double> incidences = text.counted_list("incidences");
      if (faults.empty()) require_angles(incidences, "incidence", 0, 90, faults);
      for (const double incidence : incidences) {
        Table& table = out.tables.emplace_back();
        table.rotation_deg = rotations[r], table.incidence_deg = incidence, table.transmission = through;
      }
    }
  }
  for (const bool through : {false, true}) {
    if (!(through ? transmission : reflection) || !faults.empty()) continue;
    text.list(2, "theta and phi of the spectrum");
    while (faults.empty() && !text.at_end() && parse_number(text.peek().text).fault != nullptr) text.next();  // a free line
    const std::size_t count = faults.empty() ? text.count("wavelengths") : 0;
    const std::vector<double> spectrum =
        faults.empty() && text.can_hold(2 * count) ? text.list(2 * count, "a wavelength and a percentage") : std::vector<double>();
    out.spectrum += fmt::format("{}{} nm and %: {}", out.spectrum.empty() ? "" : "; ", through ? "transmission" : "reflection",
                                fmt::join(spectrum, " "));
  }
  for (Table& table : out.tables)
    if (faults.empty()) read_table(text, !bsdf, table, faults);
  return out;
}

void choose_side(Content& content, const ReadOptions& options, FaultList& faults) {
  const bool both = std::any_of(content.tables.begin(), content.tables.end(),
                                [&](const Table& table) { return table.transmission != content.tables.front().transmission; });
  const auto answer = options.assumed("scatter");
  if (answer && *answer != "BRDF" && *answer != "BTDF")
    faults.add(faults.file(), fmt::format("--assume scatter={}", *answer), "BRDF or BTDF");
  if (both && !answer) faults.add(faults.file(), "reflection and transmission", "--assume scatter=BRDF or scatter=BTDF");
  if (answer) std::erase_if(content.tables, [&](const Table& table) { return table.transmission != (*answer == "BTDF"); });
  if (content.tables.empty() && faults.empty()) faults.add(faults.file(), "no table", "at least one");
}

/// Scales a table to its percentage where that is asked for; where it differs and nothing is said, that is a fault.
void scale(Table& table, const ReadOptions& options, FaultList& faults) {
  const auto answer = options.assumed("scale");
  if (answer && *answer != "stored" && *answer != "percentage")
    faults.add(faults.file(), fmt::format("--assume scale={}", *answer), "stored or percentage");
  const double integral = polar_integral(table.block.theta_deg, table.block.phi_deg, table.block.values[0]),
               wanted = table.percentage / 100;
  constexpr double tolerance = 0.05;
  if (!answer && std::fabs(integral - wanted) > tolerance * std::max(integral, wanted))
    faults.add_at(
        table.line,
        fmt::format("a table whose integral of f cos theta_o is {:.3g} % under a percentage of {:.3g}", 100 * integral, table.percentage),
        "--assume scale=stored or scale=percentage");
  if (answer == "percentage" && integral > 0)
    for (double& value : table.block.values[0]) value *= wanted / integral;
}

}  // namespace

Dataset read_speos(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const std::string bytes = read_file(path);
  const Preamble preamble = read_preamble(bytes, faults);
  faults.raise();
  KeywordText text(std::string_view(bytes).substr(preamble.end), faults, preamble.lines + 1);
  Content content = preamble.anisotropic ? read_anisotropic(text, faults) : read_isotropic(text, faults);
  faults.raise();
  if (text.take("End")) text.take("of"), text.take("file");
  if (!text.at_end()) faults.add_at(text.peek().line, excerpt(text.peek().text), "the end of the file");
  choose_side(content, options, faults);
  faults.raise();

  Dataset out;
  out.channels = content.channels;
  out.side = content.tables.front().transmission ? Side::transmission : Side::reflection;
  const bool turned = std::any_of(content.tables.begin(), content.tables.end(),
                                  [&](const Table& table) { return table.rotation_deg != content.tables.front().rotation_deg; });
  out.symmetry.isotropic = !turned;
  const auto sense = options.assumed("rotation");
  if (turned && sense != "counter-clockwise" && sense != "clockwise")
    faults.add(faults.file(), "anisotropy angles without their sense", "--assume rotation=counter-clockwise or rotation=clockwise");
  std::string percentages;
  const std::size_t channels = out.channels.size();
  for (std::size_t k = 0; k + channels <= content.tables.size(); k += channels) {
    PolarBlock block = content.tables[k].block;
    block.values.clear();
    for (std::size_t c = 0; c < channels; ++c) {
      Table& table = content.tables[k + c];
      if (table.block.theta_deg != block.theta_deg || table.block.phi_deg != block.phi_deg)
        faults.add_at(table.line, "angles that differ from those of the first wavelength", "the same at all wavelengths of an incidence");
      if (!preamble.anisotropic) {
        scale(table, options, faults);
        percentages += fmt::format("{}{}", percentages.empty() ? "" : " ", table.percentage);
      }
      block.values.push_back(table.block.values[0]);
    }
    const double turn = turned ? 180 + (sense == "clockwise" ? -1 : 1) * content.tables[k].rotation_deg : 0;
    block.theta_i = degrees(content.tables[k].incidence_deg);
    block.phi_i = degrees(turn < 360 ? turn : turn - 360);
    block.phi_of_first_axis = block.phi_i + degrees(180);
    if (faults.empty()) append_samples(block, out);
  }
  if (faults.empty() && out.size() == 0) faults.add(faults.file(), "no direction on the side of the scatter", "at least one");
  faults.raise();
  out.provenance["source"] = path.filename().string();
  if (!preamble.comment.empty()) out.provenance["comment"] = preamble.comment;
  if (!percentages.empty()) out.provenance["speos_percentages"] = percentages;
  if (!content.spectrum.empty()) out.provenance["speos_spectrum"] = content.spectrum;
  return out;
}

bool recognises_speos(std::string_view head, std::uintmax_t) {
  return head.starts_with(isotropic_title) || head.starts_with(anisotropic_title);
}

Opened open_speos(const std::filesystem::path& path, const ReadOptions& options) {
  Opened out = opened_grid("speos", std::make_shared<const Dataset>(read_speos(path, options)));
  out.info.insert(out.info.begin(),
                  {{"holds", "f, cosine not included"}, {"unit", "1/sr"}, {"nodes", "at samples; azimuth 0 on the specular side"}});
  return out;
}

}  // namespace gonio::tabulated
