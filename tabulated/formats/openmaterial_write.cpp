// SPDX-License-Identifier: BSD-3-Clause
// Writing look-up tables of OpenMATERIAL 3D.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "data-schemas/document.hpp"
#include "tabulated/formats/openmaterial.hpp"
#include "tabulated/samples_to_write.hpp"

namespace gonio::tabulated {
namespace {

/// The largest angles the schema takes.
constexpr double last_theta = 1.570796, last_phi = 6.283185;
constexpr double nm_per_m = 1e9;

/// Wavelength per channel in metres, or nothing where none is known.
std::vector<std::optional<double>> wavelengths_of(const Channels& channels, const std::filesystem::path& path, ExportNotes& notes) {
  std::vector<std::optional<double>> out;
  for (const Channel& channel : channels)
    out.push_back(channel.wavelength_in_nm ? std::optional(*channel.wavelength_in_nm / nm_per_m) : std::nullopt);
  const auto known = static_cast<std::size_t>(std::count_if(out.begin(), out.end(), [](const auto& nm) { return nm.has_value(); }));
  if (known == channels.size()) return out;
  if (channels.size() == 3 && channels[0].name == "r" && channels[1].name == "g" && channels[2].name == "b") {
    notes.lost.emplace_back("r, g and b stand at 611.4, 549.1 and 464.3 nm, the dominant wavelengths of the primaries of sRGB");
    for (std::size_t c = 0; c < 3; ++c) out[c] = primary_wavelengths_nm[c] / nm_per_m;
    return out;
  }
  if (channels.size() == 1) {
    notes.lost.emplace_back("the wavelength is not known: it is null");
    return out;
  }
  throw Error(ErrorKind::input, {path.string(), fmt::format("{} channels of which {} have a wavelength", channels.size(), known),
                                 "channels with wavelengths, r, g, b, or a single one"});
}

void require_isotropic(const Dataset& data, const std::filesystem::path& path, ExportNotes& notes) {
  if (data.symmetry.isotropic) return;
  const double phi_i = data.angles.front().phi_i.degrees();
  // At the normal the light has no azimuth.
  for (const GonioAngles& at : data.angles)
    if (at.phi_i.degrees() != phi_i && at.theta_i.degrees() != 0)
      throw Error(ErrorKind::input, {path.string(), "samples at several phi_i that are not known to be isotropic", "an isotropic BRDF"});
  notes.lost.emplace_back("phi_i: the format takes every BRDF for isotropic");
}

using Row = std::array<double, 5>;

std::vector<Row> rows_of(const Dataset& data, const std::vector<std::optional<double>>& wavelengths) {
  std::vector<Row> out;
  for (std::size_t c = 0; c < wavelengths.size(); ++c)
    for (std::size_t k = 0; k < data.size(); ++k) {
      if (std::isnan(data.f[c][k])) continue;
      const GonioAngles& at = data.angles[k];
      const bool turned = (at.theta_i.degrees() < 0) != (at.theta_o.degrees() < 0);
      const double phi = std::fmod((at.phi_o - at.phi_i).radians() + (turned ? std::numbers::pi : 0), 2 * std::numbers::pi);
      out.push_back({wavelengths[c].value_or(0), std::min(std::fabs(at.theta_i.radians()), last_theta),
                     std::min(std::fabs(at.theta_o.radians()), last_theta), std::min(phi < 0 ? phi + 2 * std::numbers::pi : phi, last_phi),
                     std::max(0.0, data.f[c][k])});
    }
  std::stable_sort(out.begin(), out.end(),
                   [](const Row& a, const Row& b) { return std::lexicographical_compare(a.begin(), a.end() - 1, b.begin(), b.end() - 1); });
  return out;
}

/// A name made from the values (RFC 9562, version 8).
std::string uuid_of(const std::string& bytes) {
  std::string hex = sha256(bytes).substr(0, 32);
  hex[12] = '8';
  hex[16] = '8';
  return fmt::format("{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4), hex.substr(16, 4), hex.substr(20));
}

/// The metadata the samples came with, if the rules still accept them; else new ones.
Json metadata_of(const Dataset& data, const std::string& uuid, ExportNotes& notes) {
  const auto text_of = [&](const char* key, const char* otherwise) {
    const auto at = data.provenance.find(key);
    return at == data.provenance.end() ? std::string(otherwise) : at->second;
  };
  if (const std::string kept = text_of("openmaterial_metadata", ""); !kept.empty()) try {
      const Json metadata = parse_json(kept, "openmaterial_metadata");
      const std::vector<Fault> faults = faults_of(Json::object({{"metadata", metadata}}), Schema::openmaterial_brdf, "");
      if (std::none_of(faults.begin(), faults.end(), [](const Fault& fault) { return fault.where.starts_with("#/metadata"); }))
        return metadata;
    } catch (const Error&) {  // a text that is no JSON any more: made anew below
    }
  notes.lost.emplace_back("copyright, licence and authors are wanted by the schema and not known: they read 'unknown'");
  return Json::object({{"name", text_of("sample", "unknown")},
                       {"uuid", uuid},
                       {"materialVersion", "1.0.0"},
                       {"openMaterial3dVersion", "1.0.0"},
                       {"copyrights", Json(Json::Array{Json("unknown")})},
                       {"license", "unknown"},
                       {"authors", Json(Json::Array{Json("unknown")})},
                       {"sources", data.simulated ? "simulation" : text_of("sources", "written by gonio")}});
}

}  // namespace

ExportNotes write_openmaterial(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  const auto data = with_both_sides(samples_to_write(source, options, notes));
  if (data->side == Side::transmission) throw Error(ErrorKind::input, {path.string(), "samples of transmission", "reflection"});
  require_isotropic(*data, path, notes);
  const std::vector<std::optional<double>> wavelengths = wavelengths_of(data->channels, path, notes);
  if (notes.n_negative > 0) notes.lost.emplace_back("negative values, which the format excludes, are 0");
  if (data->has_uncertainty()) notes.lost.emplace_back("uncertainties have no place in the format");

  Json table = Json::array(), list = Json::array(), receivers = Json::array();
  for (const Row& row : rows_of(*data, wavelengths))
    table.push_back(Json(Json::Array{row[0] > 0 ? Json(row[0]) : Json(), row[1], row[2], row[3], row[4]}));
  std::vector<std::optional<double>> sorted = wavelengths;
  std::sort(sorted.begin(), sorted.end());
  for (const auto& wavelength : sorted)
    if (wavelength) list.push_back(*wavelength);
  Json brdf = Json::object({{"wavelengths", list}});
  if (const auto half_angle = data->apertures.receiver_half_angle_deg; half_angle && *half_angle > 0 && list.size() > 0) {
    const double sine = std::sin(*half_angle / 2 * std::numbers::pi / 180);
    for (const Json& wavelength : list.elements())
      receivers.push_back(Json::object({{"wavelength", wavelength}, {"solidAngle", 4 * std::numbers::pi * sine * sine}}));
    brdf.set("receiverSolidAngles", receivers);
  }
  brdf.set("lookupTable", table);
  const Json metadata = metadata_of(*data, uuid_of(brdf.dump(-1)), notes);
  write_file_atomically(path, Json::object({{"metadata", metadata}, {"brdf", brdf}}).dump());
  notes.files = {path};
  notes.facts.emplace_back("angles", "radians, azimuth from the direction to the light: mirror at pi");
  return notes;
}

}  // namespace gonio::tabulated
