// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace gonio::tabulated {
namespace {

constexpr std::array extra_names{"repeat", "n", "time_s", "range", "x_mm", "y_mm"};
constexpr std::array extra_prefixes{"c_", "measured_", "var_"};

/// The unit in nm of a column of wavelengths, or 0 for any other name.
double wavelength_unit_nm(std::string_view name) {
  if (name == "wavelength_nm") return 1;
  return name == "wavelength_um" ? 1000 : 0;
}

/// Gathers the layout; one call per name, from whichever side it comes.
class LayoutBuilder {
 public:
  LayoutBuilder(std::size_t column_count, const CsvMetadata& metadata, FaultList& faults) : metadata_(metadata), faults_(faults) {
    layout_.columns.resize(column_count);
    for (const Channel& channel : metadata.description.channels) layout_.channels.push_back(channel.name);
  }

  /// Channels must be known before their uncertainties: call for every name before `target_of`.
  void note_channel(const std::string& name) {
    if (is_channel_name(name) && std::find(layout_.channels.begin(), layout_.channels.end(), name) == layout_.channels.end())
      layout_.channels.push_back(name);
  }

  /// What `name` means. A second use of the same name is a fault.
  CsvTarget target_of(const std::string& name, const std::string& where) {
    if (!used_.insert(canonical(name)).second) faults_.add(where, fmt::format("a second source of {}", name), "each quantity once");
    if (const auto angle = angle_named(name)) {
      layout_.in_radians[angle->index] = angle->in_radians;
      return {CsvTarget::Kind::angle, angle->index};
    }
    if (wavelength_unit_nm(name) > 0) {
      layout_.wavelength_unit_nm = wavelength_unit_nm(name);
      return {CsvTarget::Kind::wavelength, 0};
    }
    if (is_extra(name)) {
      layout_.extras.push_back(name);
      return {CsvTarget::Kind::extra, layout_.extras.size() - 1};
    }
    if (const auto channel = channel_index(name)) return {CsvTarget::Kind::channel, *channel};
    if (name.starts_with("u_"))
      if (const auto channel = channel_index(name.substr(2))) {
        layout_.has_uncertainty = true;
        return {CsvTarget::Kind::uncertainty, *channel};
      }
    return {};
  }

  bool is_used(const std::string& name) const { return used_.contains(canonical(name)); }
  bool is_extra(const std::string& name) const {
    return is_extra_name(name) || std::find(metadata_.extras.begin(), metadata_.extras.end(), name) != metadata_.extras.end();
  }
  bool is_channel_name(const std::string& name) const {
    return !name.empty() && !angle_named(name) && !(wavelength_unit_nm(name) > 0) && !is_extra(name) && !name.starts_with("u_");
  }

  CsvLayout& layout() { return layout_; }

 private:
  /// An angle or a wavelength is the same quantity in either unit.
  static std::string canonical(const std::string& name) {
    if (wavelength_unit_nm(name) > 0) return "wavelength";
    const auto angle = angle_named(name);
    return angle ? angle_names[angle->index] : name;
  }
  std::optional<std::size_t> channel_index(const std::string& name) const {
    const auto found = std::find(layout_.channels.begin(), layout_.channels.end(), name);
    if (found == layout_.channels.end()) return std::nullopt;
    return static_cast<std::size_t>(found - layout_.channels.begin());
  }

  const CsvMetadata& metadata_;
  FaultList& faults_;
  CsvLayout layout_;
  std::set<std::string> used_;
};

/// The column a mapping points to: the header's name first, else a 1-based position.
std::optional<std::size_t> column_of(const std::string& text, const std::vector<std::string>& header, std::size_t column_count) {
  const auto named = std::find(header.begin(), header.end(), text);
  if (named != header.end()) return static_cast<std::size_t>(named - header.begin());
  std::size_t position = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), position);
  if (error == std::errc() && end == text.data() + text.size() && position >= 1 && position <= column_count) return position - 1;
  return std::nullopt;
}

std::string listed(const std::vector<std::string>& header, std::size_t column_count) {
  if (header.empty()) return fmt::format("a position from 1 to {} (the file has no header row)", column_count);
  return fmt::format("one of {}, or a position from 1 to {}", fmt::join(header, ", "), column_count);
}

void require_complete(LayoutBuilder& builder, const ReadOptions& options, FaultList& faults) {
  const auto has = [&](AngleIndex angle) { return builder.is_used(std::string(angle_names[angle]) + "_deg"); };
  const auto missing = [&](AngleIndex angle, const char* otherwise) {
    faults.add(
        faults.file(), fmt::format("no column {}_deg", angle_names[angle]),
        fmt::format("a column of that name, --columns {0}_deg=NAME or POSITION, or --set {0}_deg=VALUE{1}", angle_names[angle], otherwise));
  };
  for (const AngleIndex angle : {theta_i, theta_o})
    if (!has(angle)) missing(angle, "");
  if (has(phi_i) || has(phi_o)) {
    for (const AngleIndex angle : {phi_i, phi_o})
      if (!has(angle)) missing(angle, "");
    if (options.in_plane) faults.add(faults.file(), "azimuths, and an in-plane sign rule for a file without them", "one of the two");
  } else if (options.in_plane) {
    builder.layout().azimuths_from_plane = true;
  } else {
    for (const AngleIndex angle : {phi_i, phi_o})
      missing(angle, "; for a file in one plane --in-plane specular-positive or specular-negative");
  }
  if (builder.layout().channels.empty())
    faults.add(faults.file(), "no column of values", "a column that is a channel, or --columns value=NAME or POSITION");
}

}  // namespace

bool is_extra_name(std::string_view name) {
  return std::find(extra_names.begin(), extra_names.end(), name) != extra_names.end() ||
         std::any_of(extra_prefixes.begin(), extra_prefixes.end(), [&](const char* prefix) { return name.starts_with(prefix); });
}

std::optional<NamedAngle> angle_named(std::string_view name) {
  const bool in_degrees = name.ends_with("_deg"), in_radians = name.ends_with("_rad");
  if (!in_degrees && !in_radians) return std::nullopt;
  name.remove_suffix(4);
  for (std::size_t k = 0; k < angle_names.size(); ++k)
    if (name == angle_names[k]) return NamedAngle{k, in_radians};
  return std::nullopt;
}

CsvLayout layout_of(const std::vector<std::string>& header, std::size_t column_count, const ReadOptions& options,
                    const CsvMetadata& metadata, FaultList& faults) {
  LayoutBuilder builder(column_count, metadata, faults);
  const bool channels_are_mapped = std::any_of(options.columns.begin(), options.columns.end(),
                                               [&](const auto& mapping) { return builder.is_channel_name(mapping.first); });

  // Positions that a mapping takes are no longer what the header calls them.
  std::vector<bool> mapped(column_count, false);
  for (const auto& [name, text] : options.columns) {
    builder.note_channel(name);
    if (const auto column = column_of(text, header, column_count)) mapped[*column] = true;
  }
  if (!channels_are_mapped && !metadata.ours)
    for (std::size_t k = 0; k < header.size(); ++k)
      if (!mapped[k]) builder.note_channel(header[k]);

  for (const auto& [name, text] : options.columns) {
    const std::string where = fmt::format("--columns {}={}", name, text);
    const auto column = column_of(text, header, column_count);
    if (!column) {
      faults.add(where, fmt::format("no such column in {}", faults.file()), listed(header, column_count));
      continue;
    }
    const CsvTarget target = builder.target_of(name, where);
    if (target.kind == CsvTarget::Kind::ignored)
      faults.add(where, "a name that is no angle, channel or known column", "the name of a channel after u_");
    if (builder.layout().columns[*column].kind != CsvTarget::Kind::ignored)
      faults.add(where, "a column that is mapped twice", "each column once");
    builder.layout().columns[*column] = target;
  }
  for (std::size_t k = 0; k < header.size(); ++k)
    if (!mapped[k] && !(header[k].empty())) {
      const CsvTarget target = builder.target_of(header[k], faults.file());
      builder.layout().columns[k] = target;
      if (target.kind == CsvTarget::Kind::ignored && metadata.ours)
        faults.add(faults.file(), fmt::format("a column {} that the lines above do not name", excerpt(header[k])),
                   "a line '# channel.NUMBER: NAME' or '# extra.NUMBER: NAME'");
    }
  for (const auto& [name, value] : options.set) {
    const std::string where = fmt::format("--set {}", name);
    if (!std::isfinite(value)) faults.add(where, "a value that is not finite", "a number");
    const CsvTarget target = builder.target_of(name, where);
    if (target.kind == CsvTarget::Kind::ignored || target.kind == CsvTarget::Kind::channel)
      faults.add(where, "a name that is no angle, u_<channel> or known column", "what the file has no column for");
    builder.layout().constants.push_back({target, value});
  }
  for (const Channel& channel : metadata.description.channels)
    if (!builder.is_used(channel.name))
      faults.add(faults.file(), fmt::format("no column {} for the channel of that name", excerpt(channel.name)), "one column per channel");
  for (const std::string& name : metadata.extras)
    if (!builder.is_used(name))
      faults.add(faults.file(), fmt::format("no column {}", excerpt(name)), "one column per line '# extra.NUMBER'");
  for (std::size_t k = 0; k < column_count; ++k)
    if (builder.layout().columns[k].kind == CsvTarget::Kind::ignored)
      builder.layout().left_out.push_back(header.empty() || header[k].empty() ? fmt::format("column {}", k + 1) : header[k]);
  require_complete(builder, options, faults);
  return std::move(builder.layout());
}

}  // namespace gonio::tabulated
