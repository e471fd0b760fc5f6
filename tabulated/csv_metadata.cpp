// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/csv_metadata.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "tabulated/csv_text.hpp"

namespace gonio::tabulated {
namespace {

template <class T, class Field>
struct Named {
  std::string_view name;
  Field T::*field;
};

constexpr std::array<Named<Apertures, std::optional<double>>, 4> aperture_fields{{
    {"source_half_angle_deg", &Apertures::source_half_angle_deg},
    {"receiver_half_angle_deg", &Apertures::receiver_half_angle_deg},
    {"spot_diameter_m", &Apertures::spot_diameter_m},
    {"field_diameter_m", &Apertures::field_diameter_m},
}};
constexpr std::array<Named<MaskedCounts, std::size_t>, 4> masked_fields{{
    {"nan", &MaskedCounts::nan},
    {"missing", &MaskedCounts::missing},
    {"below_horizon", &MaskedCounts::below_horizon},
    {"blocked", &MaskedCounts::blocked},
}};
constexpr std::array<Named<Symmetry, bool>, 3> symmetry_fields{{
    {"isotropic", &Symmetry::isotropic},
    {"bilateral", &Symmetry::bilateral},
    {"reciprocal", &Symmetry::reciprocal},
}};
constexpr std::array<Named<Channel, std::optional<double>>, 3> channel_numbers{{
    {"wavelength_in_nm", &Channel::wavelength_in_nm},
    {"wavelength_out_nm", &Channel::wavelength_out_nm},
    {"bandwidth_nm", &Channel::bandwidth_nm},
}};
constexpr std::array<Named<Channel, std::optional<std::string>>, 2> channel_texts{{
    {"polarisation_in", &Channel::polarisation_in},
    {"polarisation_out", &Channel::polarisation_out},
}};

std::string escaped(std::string_view text, bool key) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\\\";
    else if (c == '\n')
      out += "\\n";
    else if (c == '\r')
      out += "\\r";
    else if (c == ':' && key)
      out += "\\:";
    else
      out += c;
  }
  return out;
}

std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '\\' || at + 1 == text.size()) {
      out += text[at];
      continue;
    }
    const char c = text[++at];
    out += c == 'n' ? '\n' : c == 'r' ? '\r' : c;
  }
  return out;
}

std::size_t unescaped_colon(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\\')
      ++at;
    else if (text[at] == ':')
      return at;
  }
  return std::string_view::npos;
}

std::optional<double> finite_number(std::string_view text) {
  const Number number = parse_number(text);
  if (number.fault != nullptr || std::isnan(number.value)) return std::nullopt;
  return number.value;
}

/// `channel.<name>.<field>`, where the name may itself hold dots.
bool read_channel_field(std::string_view rest, const std::string& value, Channels& channels) {
  const std::size_t dot = rest.rfind('.');
  if (dot == std::string_view::npos) return false;
  const std::string_view name = rest.substr(0, dot), field = rest.substr(dot + 1);
  for (Channel& channel : channels) {
    if (channel.name != name) continue;
    for (const auto& [label, member] : channel_numbers)
      if (label == field) return (channel.*member = finite_number(value)).has_value();
    for (const auto& [label, member] : channel_texts)
      if (label == field) return (channel.*member = value).has_value();
  }
  return false;
}

bool read_symmetry(std::string_view words, Symmetry& symmetry) {
  std::vector<std::string_view> fields;
  split(words, blanks, fields);
  for (const std::string_view word : fields) {
    bool known = word == "none";
    for (const auto& [label, member] : symmetry_fields)
      if (label == word) known = symmetry.*member = true;
    if (!known) return false;
  }
  return true;
}

bool read_entry(const std::string& key, const std::string& value, CsvMetadata& metadata) {
  Dataset& out = metadata.description;
  const auto rest_after = [&](std::string_view prefix) -> std::optional<std::string_view> {
    if (!key.starts_with(prefix)) return std::nullopt;
    return std::string_view(key).substr(prefix.size());
  };
  if (key == "channel") {
    out.channels.push_back(single_channel(value).front());
    return true;
  }
  if (key == "extra") {
    metadata.extras.push_back(value);
    return true;
  }
  if (key == "symmetry") return read_symmetry(value, out.symmetry);
  if (key == "side") {
    out.side = value == "transmission" ? Side::transmission : Side::reflection;
    return value == "transmission" || value == "reflection";
  }
  if (key == "simulated") {
    out.simulated = value == "true";
    return value == "true" || value == "false";
  }
  if (const auto rest = rest_after("channel.")) return read_channel_field(*rest, value, out.channels);
  if (const auto rest = rest_after("provenance.")) {
    out.provenance[std::string(*rest)] = value;
    return true;
  }
  const std::optional<double> number = finite_number(value);
  if (!number) return false;
  if (const auto rest = rest_after("correlated.")) {
    out.correlated.push_back({std::string(*rest), *number, {}});
    return *number >= 0;
  }
  if (const auto rest = rest_after("aperture."))
    for (const auto& [label, member] : aperture_fields)
      if (label == *rest) {
        out.apertures.*member = *number;
        return *number >= 0;
      }
  if (const auto rest = rest_after("masked."))
    for (const auto& [label, member] : masked_fields)
      if (label == *rest) {
        constexpr double largest_exact = 9007199254740992.0;  // 2^53
        if (!(*number >= 0) || *number > largest_exact) return false;
        out.masked.*member = static_cast<std::size_t>(*number);
        return true;
      }
  return false;
}

}  // namespace

void read_metadata_line(std::string_view line, std::size_t number, CsvMetadata& metadata, FaultList& faults) {
  if (line == csv_signature && number == 1) {
    metadata.ours = true;
    return;
  }
  if (!metadata.ours || !line.starts_with("# ")) return;
  const std::string_view text = line.substr(2);
  const std::size_t colon = unescaped_colon(text);
  if (colon == std::string_view::npos) return;
  const std::string key = unescaped(text.substr(0, colon));
  std::string_view value = text.substr(colon + 1);
  if (value.starts_with(' ')) value.remove_prefix(1);
  if (!read_entry(key, unescaped(value), metadata)) faults.add_at(number, excerpt(line), "a known key with a value of its kind");
}

std::string metadata_lines(const Dataset& dataset) {
  std::string out = fmt::format("{}\n", csv_signature);
  const auto entry = [&](std::string_view key, std::string_view value) {
    out += fmt::format("# {}: {}\n", escaped(key, true), escaped(value, false));
  };
  const auto number = [&](const std::string& key, double value) {
    std::string text;
    append_number(text, value);
    entry(key, text);
  };
  for (const Channel& channel : dataset.channels) {
    entry("channel", channel.name);
    for (const auto& [label, member] : channel_numbers)
      if (channel.*member) number(fmt::format("channel.{}.{}", channel.name, label), *(channel.*member));
    for (const auto& [label, member] : channel_texts)
      if (channel.*member) entry(fmt::format("channel.{}.{}", channel.name, label), *(channel.*member));
  }
  std::string symmetry;
  for (const auto& [label, member] : symmetry_fields)
    if (dataset.symmetry.*member) symmetry += fmt::format("{}{}", symmetry.empty() ? "" : " ", label);
  entry("symmetry", symmetry.empty() ? "none" : symmetry);
  entry("side", dataset.side == Side::transmission ? "transmission" : "reflection");
  entry("simulated", dataset.simulated ? "true" : "false");
  for (const auto& [label, member] : aperture_fields)
    if (dataset.apertures.*member) number(fmt::format("aperture.{}", label), *(dataset.apertures.*member));
  for (const CorrelatedComponent& component : dataset.correlated) number(fmt::format("correlated.{}", component.name), component.u);
  for (const auto& [label, member] : masked_fields)
    if (dataset.masked.*member > 0) entry(fmt::format("masked.{}", label), std::to_string(dataset.masked.*member));
  for (const auto& [name, values] : dataset.extra) entry("extra", name);
  for (const auto& [key, value] : dataset.provenance) entry(fmt::format("provenance.{}", key), value);
  return out;
}

}  // namespace gonio::tabulated
