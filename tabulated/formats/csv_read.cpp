// SPDX-License-Identifier: BSD-3-Clause
// From the rows of a CSV file to samples of a BRDF: blank, quantity, angles.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "tabulated/formats/csv.hpp"
#include "tabulated/formats/csv_table.hpp"
#include "tabulated/formats/csv_wavelengths.hpp"
#include "tabulated/opened_samples.hpp"
#include "tabulated/quantity.hpp"

namespace gonio::tabulated {
namespace {

using RawDirections = std::array<double, 4>;

RawDirections directions_of(const CsvTable& table, std::size_t row) {
  RawDirections out;
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = table.angles[k][row];
  return out;
}

/// The blank at one pose: means over its repeats.
struct BlankReading {
  std::size_t repeats = 0;
  std::vector<double> value, variance;  ///< per channel; sums while reading
};

std::map<RawDirections, BlankReading> read_blank(const std::filesystem::path& path, const ReadOptions& options, const CsvTable& samples) {
  const CsvTable blank = read_csv_table(path, options);
  if (blank.layout.channels != samples.layout.channels || blank.layout.in_radians != samples.layout.in_radians)
    throw Error(ErrorKind::input,
                {path.string(), "channels or units that differ from those of the samples", "a file with the same columns"});
  std::map<RawDirections, BlankReading> out;
  const std::size_t channel_count = blank.values.size();
  for (std::size_t row = 0; row < blank.size(); ++row) {
    BlankReading& reading = out[directions_of(blank, row)];
    reading.value.resize(channel_count);
    reading.variance.resize(channel_count);
    ++reading.repeats;
    for (std::size_t c = 0; c < channel_count; ++c) {
      reading.value[c] += blank.values[c][row];
      if (!blank.u.empty()) reading.variance[c] += blank.u[c][row] * blank.u[c][row];
    }
  }
  for (auto& [directions, reading] : out) {
    const auto n = static_cast<double>(reading.repeats);
    for (std::size_t c = 0; c < channel_count; ++c) reading.value[c] /= n, reading.variance[c] /= n * n;
  }
  return out;
}

/// Subtracts at the poses as they are written, so that two arm positions of one direction keep their own blanks.
void subtract_blank(CsvTable& table, const std::filesystem::path& path, const ReadOptions& options, FaultList& faults) {
  const auto blank = read_blank(path, options, table);
  for (std::size_t row = 0; row < table.size(); ++row) {
    const RawDirections directions = directions_of(table, row);
    const auto found = blank.find(directions);
    if (found == blank.end()) {
      faults.add(path.string(), fmt::format("no reading at ({})", fmt::join(directions, ", ")),
                 "a blank at every direction of the samples");
      continue;
    }
    for (std::size_t c = 0; c < table.values.size(); ++c) {
      table.values[c][row] -= found->second.value[c];
      if (!table.u.empty()) table.u[c][row] = std::sqrt(table.u[c][row] * table.u[c][row] + found->second.variance[c]);
    }
  }
}

/// Turns the columns of angles into angles, and signed zenith angles into a zenith angle and an azimuth. Grids repeat few values:
/// each angle is looked up among those seen last before its cosine is computed again.
class AngleMaker {
 public:
  AngleMaker(const CsvLayout& layout, std::optional<InPlane> in_plane) : in_radians_(layout.in_radians) {
    if (layout.azimuths_from_plane && in_plane == InPlane::specular_positive) phi_o_of_plane_ = degrees(180);
    if (layout.azimuths_from_plane) plane_ = true;
  }

  GonioAngles operator()(const RawDirections& raw) {
    GonioAngles out{angle(theta_i, raw), angle(phi_i, raw), angle(theta_o, raw), angle(phi_o, raw)};
    if (plane_) out.phi_o = phi_o_of_plane_;
    unfold(out.theta_i, out.phi_i);
    unfold(out.theta_o, out.phi_o);
    return out;
  }

 private:
  static void unfold(Angle& theta, Angle& phi) {
    if (theta.degrees() >= 0) return;
    theta = -theta;
    phi = phi.degrees() < 180 ? phi + degrees(180) : phi - degrees(180);
  }

  Angle angle(AngleIndex which, const RawDirections& raw) {
    const double value = raw[which];
    // Multiplicative hash of the bits (Knuth, The Art of Computer Programming 3, 6.4); the top bits choose the slot.
    const auto slot = static_cast<std::size_t>((std::bit_cast<std::uint64_t>(value) * 0x9E3779B97F4A7C15u) >> (64 - slot_bits));
    Slot& seen = slots_[which][slot];
    if (!seen.used || std::bit_cast<std::uint64_t>(seen.value) != std::bit_cast<std::uint64_t>(value))
      seen = {true, value, in_radians_[which] ? radians(value) : degrees(value)};
    return seen.angle;
  }

  static constexpr unsigned slot_bits = 9;
  struct Slot {
    bool used = false;
    double value = 0;
    Angle angle;
  };
  std::array<bool, 4> in_radians_;
  bool plane_ = false;
  Angle phi_o_of_plane_;
  std::array<std::vector<Slot>, 4> slots_{std::vector<Slot>(1u << slot_bits), std::vector<Slot>(1u << slot_bits),
                                          std::vector<Slot>(1u << slot_bits), std::vector<Slot>(1u << slot_bits)};
};

/// Samples whose value turned out unknown are taken out and counted.
Dataset to_dataset(CsvTable&& table, const ReadOptions& options, FaultList& faults) {
  Dataset out = std::move(table.metadata.description);
  if (!table.metadata.ours)
    for (const std::string& name : table.layout.channels) out.channels.push_back(single_channel(name).front());
  out.masked.nan += table.masked.nan;
  out.masked.missing += table.masked.missing;
  out.masked.below_horizon += table.masked.below_horizon;

  const Quantity quantity = options.quantity.value_or(Quantity::f);
  AngleMaker make_angles(table.layout, options.in_plane);
  out.angles.reserve(table.size());
  std::size_t kept = 0;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const GonioAngles angles = make_angles(directions_of(table, row));
    const double factor = factor_to_f(quantity, angles.theta_o);
    bool known = false;
    for (auto& values : table.values) {
      values[kept] = values[row] * factor;
      known = known || !std::isnan(values[kept]);
    }
    for (auto& u : table.u) u[kept] = u[row] * factor;
    for (auto& extra : table.extras) extra[kept] = extra[row];
    if (!table.wavelength_nm.empty()) table.wavelength_nm[kept] = table.wavelength_nm[row];
    if (!known) {
      ++out.masked.nan;
      continue;
    }
    out.angles.push_back(angles);
    ++kept;
  }
  for (auto* columns : {&table.values, &table.u, &table.extras})
    for (auto& column : *columns) column.resize(kept);
  out.f = std::move(table.values);
  out.u = std::move(table.u);
  for (std::size_t k = 0; k < table.extras.size(); ++k) {
    const std::string& name = table.layout.extras[k];
    CorrelatedComponent* owner = nullptr;
    for (CorrelatedComponent& component : out.correlated)
      if (name == fmt::format("c_{}", component.name)) owner = &component;
    (owner != nullptr ? owner->sensitivity : out.extra[name]) = std::move(table.extras[k]);
  }
  if (table.wavelength_nm.empty()) return out;
  table.wavelength_nm.resize(kept);
  return channels_by_wavelength(std::move(out), table.wavelength_nm, faults);
}

}  // namespace

Dataset read_csv(const std::filesystem::path& path, const ReadOptions& options) {
  CsvTable table = read_csv_table(path, options);
  FaultList faults(path.string());
  if (table.metadata.ours && options.quantity && *options.quantity != Quantity::f)
    faults.add(path.string(), fmt::format("a file that says it holds f, to be read as {}", name(*options.quantity)),
               "no --quantity for a file of ours");
  if (options.blank && table.layout.wavelength_unit_nm > 0)
    faults.add(path.string(), "a column of wavelengths and a blank", "one of the two: a blank holds at one wavelength");
  else if (options.blank)
    subtract_blank(table, *options.blank, options, faults);
  faults.raise();
  const std::vector<std::string> left_out = table.layout.left_out;

  const bool ours = table.metadata.ours;
  const std::size_t row_count = table.row_count;
  Dataset dataset = to_dataset(std::move(table), options, faults);
  faults.raise();
  if (dataset.size() == 0) {
    const MaskedCounts& masked = dataset.masked;
    throw Error(ErrorKind::input, {path.string(),
                                   fmt::format("no sample in {} rows ({} nan, {} missing, {} below horizon)", row_count, masked.nan,
                                               masked.missing, masked.below_horizon),
                                   "at least one value"});
  }
  if (!ours) {
    dataset.provenance["source"] = path.filename().string();
    if (options.quantity) dataset.provenance["source_quantity"] = name(*options.quantity);
    if (!left_out.empty()) dataset.provenance["columns_left_out"] = fmt::format("{}", fmt::join(left_out, ", "));
    if (options.blank) dataset.provenance["blank"] = options.blank->filename().string();
  }
  return dataset;
}

bool recognises_csv(std::string_view head, std::uintmax_t) {
  // Text, perhaps with a stray control byte that the reader will name with its line; not a JSON or XML document.
  constexpr std::size_t one_stray_byte_in = 20;
  std::size_t control = 0;
  for (const char c : head)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') ++control;
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head[first] != '{' && head[first] != '<' && control * one_stray_byte_in <= head.size();
}

Opened open_csv(const std::filesystem::path& path, const ReadOptions& options) {
  Opened out = opened_samples("csv", std::make_shared<const Dataset>(read_csv(path, options)));
  const bool is_f = options.quantity.value_or(Quantity::f) == Quantity::f;
  out.info.insert(out.info.begin(), {{"holds", is_f ? "f, cosine not included" : fmt::format("{}, made f", name(*options.quantity))},
                                     {"unit", "1/sr"},
                                     {"nodes", "at the samples"}});
  return out;
}

}  // namespace gonio::tabulated
