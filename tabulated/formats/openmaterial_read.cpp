// SPDX-License-Identifier: BSD-3-Clause
// Reading look-up tables of OpenMATERIAL 3D.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_wavelengths.hpp"
#include "tabulated/formats/openmaterial.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr double nm_per_m = 1e9;

/// Raises the faults of the table; gives those of the metadata in words.
std::string raise_faults_of_table(const Json& document, FaultList& faults) {
  std::size_t n_metadata = 0;
  std::string first;
  for (const Fault& fault : faults_of(document, Schema::openmaterial_brdf, faults.file())) {
    if (fault.where.find("#/metadata") == std::string::npos) {
      faults.add(fault.where, fault.found, fault.wanted);
    } else if (n_metadata++ == 0) {
      first = fault.where.substr(fault.where.find('#')) + ": " + fault.found;
    }
  }
  faults.raise();
  return n_metadata == 0 ? "as the public schema wants them" : fmt::format("{} faults, the first {}", n_metadata, first);
}

/// Rows are sorted by the columns in their order (the value excepted); null comes first.
void require_sorted(const Json::Array& rows, FaultList& faults) {
  const auto key = [](const Json& row, std::size_t column) { return row[column].is_null() ? -1.0 : row[column].number(); };
  const auto before = [&](const Json& a, const Json& b) {
    for (std::size_t column = 0; column < 4; ++column)
      if (key(a, column) != key(b, column)) return key(a, column) < key(b, column);
    return false;
  };
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (before(rows[k], rows[k - 1]))
      faults.add(fmt::format("{}#/brdf/lookupTable/{}", faults.file(), k), "a row that belongs before the last one",
                 "rows sorted by wavelength, theta_i, theta_o, azimuth");
}

/// What is added to the file's azimuth, in radians.
double azimuth_offset(const ReadOptions& options) {
  const auto answer = options.assumed("specular_azimuth_deg");
  if (!answer || *answer == "180") return 0;
  if (*answer == "0") return std::numbers::pi;
  throw Error(ErrorKind::usage, {"--assume specular_azimuth_deg", *answer, "180 or 0"});
}

/// Channels at the wavelengths of the primaries are r, g and b.
void name_primaries(Dataset& data) {
  if (data.channels.size() != primary_wavelengths_nm.size()) return;
  for (std::size_t c = 0; c < primary_wavelengths_nm.size(); ++c)  // channels come by increasing wavelength: b, g, r
    if (data.channels[c].wavelength_in_nm != primary_wavelengths_nm[primary_wavelengths_nm.size() - 1 - c]) return;
  data.channels = rgb_channels();
  std::reverse(data.f.begin(), data.f.end());
}

std::optional<double> half_angle_deg(const Json& brdf) {
  const Json& receivers = brdf.get("receiverSolidAngles");
  if (receivers.size() == 0) return std::nullopt;
  const double omega = receivers[0].at("solidAngle").number();
  for (const Json& receiver : receivers.elements())
    if (receiver.at("solidAngle").number() != omega) return std::nullopt;
  // omega = 2 pi (1 - cos a) = 4 pi sin²(a/2)
  const double sine = std::sqrt(omega / (4 * std::numbers::pi));
  if (sine > std::numbers::sqrt2 / 2) return std::nullopt;
  return 2 * std::asin(sine) * 180 / std::numbers::pi;
}

}  // namespace

Opened open_openmaterial(const std::filesystem::path& path, const ReadOptions& options) {
  const double offset = azimuth_offset(options);
  const Json document = parse_json(read_file(path), path.string());
  FaultList faults(path.string());
  const std::string metadata_words = raise_faults_of_table(document, faults);
  const Json& brdf = document.at("brdf");
  const Json::Array& rows = brdf.at("lookupTable").elements();
  require_sorted(rows, faults);
  const auto known_wavelength = [](const Json& row) { return !row[0].is_null(); };
  const bool spectral = std::any_of(rows.begin(), rows.end(), known_wavelength);
  if (spectral && !std::all_of(rows.begin(), rows.end(), known_wavelength))
    faults.add(path.string() + "#/brdf/lookupTable", "rows with and without a wavelength", "one in every row, or in none");
  faults.raise();

  Dataset data;
  data.channels = single_channel("value");
  data.f.resize(1);
  std::vector<double> wavelength_nm;
  for (const Json& row : rows) {
    if (row[1].is_null() || row[2].is_null() || row[3].is_null() || row[4].is_null()) {
      ++data.masked.nan;
      continue;
    }
    // 555 nm is 5.55e-07: the rounding of that product is taken off again.
    constexpr double digits = 1e9;
    wavelength_nm.push_back(spectral ? std::round(row[0].number() * nm_per_m * digits) / digits : 0);
    data.angles.push_back({radians(row[1].number()), radians(0), radians(row[2].number()), radians(row[3].number() + offset)});
    data.f[0].push_back(row[4].number());
  }
  if (data.size() == 0) throw Error(ErrorKind::input, {path.string(), "no row with a value", "at least one"});
  const std::size_t n_rows = data.size();
  if (spectral) data = channels_by_wavelength(std::move(data), wavelength_nm, faults);
  name_primaries(data);
  data.symmetry.isotropic = true;
  data.apertures.receiver_half_angle_deg = half_angle_deg(brdf);
  const Json& metadata = document.get("metadata");
  if (metadata.is_object()) {
    if (metadata.get("name").is_string()) data.provenance["sample"] = metadata.at("name").string();
    if (metadata.get("sources").is_string()) data.provenance["sources"] = metadata.at("sources").string();
    data.simulated = metadata.get("sources").is_string() && metadata.at("sources").string().find("simulat") != std::string::npos;
    data.provenance["openmaterial_metadata"] = metadata.dump(-1);
  }

  Opened out = opened_grid("openmaterial-json", std::make_shared<const Dataset>(std::move(data)));
  out.info.insert(out.info.begin(), {{"holds", "f, cosine not included"},
                                     {"unit", "1/sr"},
                                     {"nodes", fmt::format("{} rows of wavelength and directions", n_rows)},
                                     {"azimuth", offset == 0 ? "from the direction to the light: mirror at 180 deg"
                                                             : "from where the light goes on: mirror at 0 deg"},
                                     {"metadata", metadata_words}});
  return out;
}

bool recognises_openmaterial(std::string_view head, std::uintmax_t) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || head[first] != '{') return false;
  const auto has = [&](std::string_view text) { return head.find(text) != std::string_view::npos; };
  return has("\"openMaterial3dVersion\"") || (has("\"lookupTable\"") && has("\"brdf\""));
}

}  // namespace gonio::tabulated
