// SPDX-License-Identifier: BSD-3-Clause
// Writing the universal BRDF data format.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "data-schemas/document.hpp"
#include "tabulated/formats/bird.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/samples_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr const char* schema_address =
    "https://raw.githubusercontent.com/BiRD-project/BiRD_view/master/BRDF_JSON_schema/brdf_json_schema_v1.0.json";
/// Stands where the time of a measurement is not known: the schema wants one.
constexpr const char* no_time = "0001-01-01T00:00:00Z";

/// One value that goes into the file.
struct Row {
  std::size_t sample, channel;
};

std::vector<Row> rows_of(const Dataset& data, ExportNotes& notes) {
  std::vector<Row> out;
  std::size_t at_horizon = 0;
  for (std::size_t sample = 0; sample < data.size(); ++sample) {
    const GonioAngles& at = data.angles[sample];
    if (std::fabs(at.theta_i.degrees()) >= 90 || std::fabs(at.theta_o.degrees()) >= 90) {
      ++at_horizon;
      continue;
    }
    for (std::size_t channel = 0; channel < data.channels.size(); ++channel)
      if (!std::isnan(data.f[channel][sample])) out.push_back({sample, channel});
  }
  notes.n_below_horizon += at_horizon;
  if (at_horizon > 0) notes.lost.push_back(fmt::format("{} pairs of directions at 90 degrees, which the format excludes", at_horizon));
  return out;
}

/// In [0, 360).
double azimuth(double phi_deg) {
  const double out = std::fmod(phi_deg, 360.0);
  const double positive = out < 0 ? out + 360 : out;
  return positive < 360 ? positive : 0;
}

/// Zenith angle and azimuth as the format has them: a negative zenith angle is half a turn.
std::pair<double, double> placed(const Angle& theta, const Angle& phi) {
  return {std::fabs(theta.degrees()), azimuth(theta.degrees() < 0 ? phi.degrees() + 180 : phi.degrees())};
}

std::string text_of(const Dataset& data, const std::string& key, std::string otherwise) {
  const auto at = data.provenance.find(key);
  return at == data.provenance.end() ? otherwise : at->second;
}

Json variable(const char* unit, Json::Array values, const Dataset& data, const std::string& name) {
  Json out = Json::object({{"unit", unit}, {"values", std::move(values)}});
  const std::string common = text_of(data, "uncertainty_" + name, "");
  const std::size_t blank = common.find(' ');
  if (blank == std::string::npos) return out;
  const Number value = parse_number(std::string_view(common).substr(0, blank));
  if (value.fault == nullptr && value.value >= 0)
    out.set("uncertainty", Json::object({{"value", value.value}, {"unit", common.substr(blank + 1)}}));
  return out;
}

/// A column of all rows.
template <class Value>
Json::Array column(std::span<const Row> rows, Value&& value) {
  Json::Array out;
  out.reserve(rows.size());
  for (const Row& row : rows) out.emplace_back(value(row));
  return out;
}

void add_uncertainty(const Dataset& data, std::span<const Row> rows, Json& out, ExportNotes& notes) {
  if (!data.has_uncertainty()) return;
  std::size_t missing = 0;
  Json::Array values = column(rows, [&](const Row& row) {
    const double u = data.total_uncertainty(row.channel, row.sample);
    missing += std::isnan(u) ? 1 : 0;
    return std::isnan(u) ? 0.0 : u;
  });
  out.set("uBRDF", Json::object({{"unit", "1/sr"},
                                 {"values", std::move(values)},
                                 {"comments", fmt::format("Standard uncertainty, coverage factor k = 1, all components together{}.",
                                                          missing > 0 ? "; 0 means unknown" : "")}}));
  notes.facts.emplace_back("uncertainty", "uBRDF in 1/sr, coverage factor k = 1");
  if (missing > 0) notes.lost.push_back(fmt::format("{} values without uncertainty have 0 in uBRDF, as its comment says", missing));
  if (!data.correlated.empty()) notes.lost.emplace_back("the components of uncertainty that samples share are added to uBRDF in squares");
}

void add_channels(const Dataset& data, std::span<const Row> rows, Json& out, Json& own) {
  const Channels& channels = data.channels;
  const auto all = [&](auto&& has) { return std::all_of(channels.begin(), channels.end(), has); };
  const auto wavelengths = [&](const char* name, auto member) {
    if (all([&](const Channel& channel) { return (channel.*member).has_value(); }))
      out.set(name, variable("nm", column(rows, [&](const Row& row) { return *(channels[row.channel].*member); }), data, name));
  };
  wavelengths("wavelength_i", &Channel::wavelength_in_nm);
  wavelengths("wavelength_r", &Channel::wavelength_out_nm);
  const auto polarisations = [&](const char* name, auto member) {
    const auto letter = [&](const Channel& channel) { return (channel.*member).value_or(""); };
    if (all([&](const Channel& channel) { return letter(channel) == "s" || letter(channel) == "p" || letter(channel) == "u"; }))
      out.set(name,
              Json::object({{"notation", "sp"}, {"values", column(rows, [&](const Row& row) { return letter(channels[row.channel]); })}}));
  };
  polarisations("polarization_i", &Channel::polarisation_in);
  polarisations("polarization_r", &Channel::polarisation_out);
  own.set("channel", Json::object({{"description", "Name of the channel, such as r, g and b."},
                                   {"unit", ""},
                                   {"type", "string"},
                                   {"values", column(rows, [&](const Row& row) { return channels[row.channel].name; })}}));
}

Json data_of(const Dataset& data, std::span<const Row> rows, ExportNotes& notes) {
  const auto angle = [&](const char* name, auto&& value) {
    return variable("deg", column(rows, [&](const Row& row) { return value(data.angles[row.sample]); }), data, name);
  };
  Json out = Json::object({{"theta_i", angle("theta_i", [](const GonioAngles& at) { return placed(at.theta_i, at.phi_i).first; })},
                           {"phi_i", angle("phi_i", [](const GonioAngles& at) { return placed(at.theta_i, at.phi_i).second; })},
                           {"theta_r", angle("theta_r", [](const GonioAngles& at) { return placed(at.theta_o, at.phi_o).first; })},
                           {"phi_r", angle("phi_r", [](const GonioAngles& at) { return placed(at.theta_o, at.phi_o).second; })},
                           {"BRDF", Json::object({{"unit", "1/sr"}, {"values", column(rows, [&](const Row& row) {
                                                                       return std::max(0.0, data.f[row.channel][row.sample]);
                                                                     })}})}});
  add_uncertainty(data, rows, out, notes);
  Json own = Json::object();
  add_channels(data, rows, out, own);
  for (const auto& [name, values] : data.extra) {
    if (std::any_of(values.begin(), values.end(), [](double value) { return !std::isfinite(value); }) || name == "channel") {
      notes.lost.push_back(fmt::format("the column {}, which is not known everywhere", name));
      continue;
    }
    own.set(name, Json::object({{"description", "Column of the samples."},
                                {"unit", ""},
                                {"type", "number"},
                                {"values", column(rows, [&values = values](const Row& row) { return values[row.sample]; })}}));
  }
  out.set("adhoc_variables", own);
  return out;
}

std::string symmetry_words(const Symmetry& symmetry) {
  if (symmetry.isotropic) return symmetry.bilateral ? "isotropic, bilaterally symmetric" : "isotropic";
  return symmetry.bilateral ? "bilaterally symmetric" : "not known";
}

Json new_metadata(const Opened& source, const Dataset& data, ExportNotes& notes) {
  notes.lost.emplace_back("organization, address and contact are wanted by the schema and not known: they read 'unknown'");
  const std::string time = text_of(data, "timestamp", no_time);
  if (time == no_time) notes.lost.push_back(fmt::format("the time of the measurement is not known: it reads {}", no_time));
  Json location = Json::object();
  for (const char* key : {"country", "city", "street", "building_nr", "postal_code"}) location.set(key, "unknown");
  const bool measured = source.dataset && !source.simulated;
  return Json::object({{"schema", schema_address},
                       {"type", "BRDF"},
                       {"timestamp", time},
                       {"provenance", Json::object({{"organization", text_of(data, "organization", "unknown")},
                                                    {"location", location},
                                                    {"email", "unknown@unknown.invalid"},
                                                    {"contact_person", "unknown"}})},
                       {"description", text_of(data, "description", fmt::format("BRDF written by gonio from a {} file", source.format))},
                       {"method", measured ? "measurement" : "simulation"},
                       {"instrumentation", "NA"},
                       {"software", Json::object({{"name", "gonio"}})},
                       {"sample", Json::object({{"name", text_of(data, "sample", "unknown")},
                                                {"type", "unknown"},
                                                {"dimensions", Json::object()},
                                                {"shape", "unknown"},
                                                {"zero_azimuth_location", "unknown"},
                                                {"properties_symmetry", symmetry_words(data.symmetry)}})},
                       {"environment", "NA"}});
}

/// The metadata the samples came with, if the rules still accept them.
Json kept_metadata(const Dataset& data) {
  const std::string text = text_of(data, "bird_metadata", "");
  if (text.empty()) return {};
  try {
    const Json metadata = parse_json(text, "bird_metadata");
    for (const Fault& fault : faults_of(Json::object({{"metadata", metadata}}), Schema::bird_brdf, ""))
      if (fault.where.find("#/metadata") != std::string::npos) return {};
    return metadata;
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

ExportNotes write_bird(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  const auto data = samples_to_write(source, options, notes);
  if (data->side == Side::transmission) throw Error(ErrorKind::input, {path.string(), "samples of transmission", "reflection"});
  const std::vector<Row> rows = rows_of(*data, notes);
  if (rows.empty()) throw Error(ErrorKind::input, {"the source", "no value below 90 degrees", "values to write"});
  if (notes.n_negative > 0) notes.lost.emplace_back("negative values, which the format excludes, are 0");

  Json document = Json::object({{"metadata", Json::object()}, {"data", data_of(*data, rows, notes)}});
  Json metadata = kept_metadata(*data);
  if (metadata.is_null()) metadata = new_metadata(source, *data, notes);
  Json own = metadata.get("adhoc_section");
  own.set("coverage_factor", 1.0).set("simulated", source.simulated);
  metadata.set("adhoc_section", own);
  // A name no other data have: what the data are.
  metadata.set("id", "urn:sha256:" + sha256(document.at("data").dump(-1)));
  document.set("metadata", metadata);
  write_file_atomically(path, document.dump());
  notes.files = {path};
  notes.facts.emplace_back("angles", "degrees, both directions away from the surface, mirror at phi_i + 180");
  return notes;
}

}  // namespace gonio::tabulated
