// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/metadata.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "tabulated/formats/csv_text.hpp"

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

std::optional<double> finite_number(std::string_view text) {
  const Number number = parse_number(text);
  if (number.fault != nullptr || std::isnan(number.value)) return std::nullopt;
  return number.value;
}

/// `<k>` or `<k>.<field>`; k is the number of the next channel, or of a known one.
bool read_channel(std::string_view rest, const std::string& value, Channels& channels) {
  std::size_t number = 0;
  const char* const end = rest.data() + rest.size();
  const auto [after, error] = std::from_chars(rest.data(), end, number);
  if (error != std::errc()) return false;
  if (after == end) {
    if (number != channels.size() + 1) return false;
    channels.push_back(single_channel(value).front());
    return true;
  }
  if (*after != '.' || number < 1 || number > channels.size()) return false;
  Channel& channel = channels[number - 1];
  const std::string_view field(after + 1, static_cast<std::size_t>(end - after - 1));
  for (const auto& [label, member] : channel_numbers)
    if (label == field) return (channel.*member = finite_number(value)).has_value();
  for (const auto& [label, member] : channel_texts)
    if (label == field) return (channel.*member = value).has_value();
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

}  // namespace

bool read_metadata_entry(const std::string& key, const std::string& value, Metadata& metadata) {
  Dataset& out = metadata.description;
  const auto rest_after = [&](std::string_view prefix) -> std::optional<std::string_view> {
    if (!key.starts_with(prefix)) return std::nullopt;
    return std::string_view(key).substr(prefix.size());
  };
  if (const auto rest = rest_after("channel.")) return read_channel(*rest, value, out.channels);
  if (rest_after("extra.")) {
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

std::vector<std::pair<std::string, std::string>> metadata_entries(const Dataset& dataset) {
  std::vector<std::pair<std::string, std::string>> out;
  const auto entry = [&](std::string key, std::string_view value) { out.emplace_back(std::move(key), value); };
  const auto number = [&](std::string key, double value) {
    std::string text;
    append_number(text, value);
    entry(std::move(key), text);
  };
  for (std::size_t k = 1; k <= dataset.channels.size(); ++k) {
    const Channel& channel = dataset.channels[k - 1];
    entry(fmt::format("channel.{}", k), channel.name);
    for (const auto& [label, member] : channel_numbers)
      if (channel.*member) number(fmt::format("channel.{}.{}", k, label), *(channel.*member));
    for (const auto& [label, member] : channel_texts)
      if (channel.*member) entry(fmt::format("channel.{}.{}", k, label), *(channel.*member));
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
  for (std::size_t k = 1; const auto& [name, values] : dataset.extra) entry(fmt::format("extra.{}", k++), name);
  for (const auto& [key, value] : dataset.provenance) entry(fmt::format("provenance.{}", key), value);
  return out;
}

}  // namespace gonio::tabulated
