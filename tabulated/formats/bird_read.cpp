// SPDX-License-Identifier: BSD-3-Clause
// Reading the universal BRDF data format.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/bird.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/row_samples.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* angle_names[] = {"theta_i", "phi_i", "theta_r", "phi_r"};

/// A column of the file; empty if it has none.
const Json::Array& values_of(const Json& data, std::string_view name) {
  static const Json::Array none;
  const Json& variable = data.get(name);
  return variable.is_object() ? variable.at("values").elements() : none;
}

/// Everything of `data` that is wrong and the rules cannot say: columns of different length, no row.
void require_equal_lengths(const Json& data, FaultList& faults) {
  const std::size_t rows = values_of(data, "BRDF").size();
  const auto check = [&](const std::string& pointer, const Json& variable) {
    if (variable.at("values").size() != rows)
      faults.add(fmt::format("{}#/data/{}/values", faults.file(), pointer), fmt::format("{} values", variable.at("values").size()),
                 fmt::format("{}, as BRDF has", rows));
  };
  for (const auto& [name, variable] : data.members())
    if (name != "adhoc_variables")
      check(name, variable);
    else
      for (const auto& [own, column] : variable.members()) check("adhoc_variables/" + own, column);
  if (rows == 0) faults.add(faults.file() + "#/data/BRDF/values", "no value", "at least one");
}

/// K of a text with `k = K`, the k no part of a word.
std::optional<double> factor_in(const std::string& text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if ((text[k] != 'k' && text[k] != 'K') || (k > 0 && std::isalnum(static_cast<unsigned char>(text[k - 1])))) continue;
    std::size_t at = text.find_first_not_of(' ', k + 1);
    if (at == std::string::npos || text[at] != '=') continue;
    at = std::min(text.find_first_not_of(' ', at + 1), text.size());
    const std::size_t end = std::min(text.find_first_not_of("0123456789.", at), text.size());
    const Number number = parse_number(std::string_view(text).substr(at, end - at));
    if (number.fault == nullptr && number.value > 0) return number.value;
  }
  return std::nullopt;
}

/// The coverage factor of the uncertainties; 1 if there are none. A fault if nothing says it.
double coverage_factor(const Json& document, const ReadOptions& options, FaultList& faults) {
  const Json& data = document.at("data");
  if (!data.contains("uBRDF") && !data.at("BRDF").contains("uncertainty")) return 1;
  if (const auto answer = options.assumed("coverage_factor")) {
    const Number number = parse_number(*answer);
    if (number.fault == nullptr && number.value > 0) return number.value;
    throw Error(ErrorKind::usage, {"--assume coverage_factor", *answer, "a positive number: 1 for standard uncertainties"});
  }
  const Json& metadata = document.get("metadata");
  const Json& own = metadata.is_object() ? metadata.get("adhoc_section") : metadata;
  if (own.is_object() && own.number_or("coverage_factor", 0) > 0) return own.at("coverage_factor").number();
  for (const char* name : {"uBRDF", "BRDF"})
    if (const Json& variable = data.get(name); variable.is_object())
      if (const auto factor = factor_in(variable.string_or("comments", ""))) return *factor;
  faults.add(faults.file() + "#/data", "uncertainties without their coverage factor",
             "--assume coverage_factor=1 if they are standard uncertainties, =2 if expanded with k = 2");
  return 1;
}

/// Number per row in 1/sr, NaN where unknown.
std::vector<double> uncertainties(const Json& data, double factor) {
  const Json::Array& f = values_of(data, "BRDF");
  std::vector<double> out(f.size(), unknown);
  const Json& varying = data.get("uBRDF");
  const Json& source = varying.is_object() ? varying : data.at("BRDF").get("uncertainty");
  if (!source.is_object()) return out;
  const bool relative = source.at("unit").string() == "%";
  for (std::size_t row = 0; row < out.size(); ++row) {
    const double value = varying.is_object() ? source.at("values")[row].number() : source.at("value").number();
    const double u = (relative ? value / 100 * f[row].number() : value) / factor;
    if (u > 0) out[row] = u;
  }
  return out;
}

std::string polarisation(const Json& value) {
  if (value.is_string()) return value.string();
  std::string out;
  for (const Json& part : value.elements()) {
    if (!out.empty()) out += ' ';
    append_number(out, part.number());
  }
  return out;
}

/// What tells one channel from another.
using ChannelKey = std::tuple<std::optional<double>, std::optional<double>, std::string, std::string, std::string>;

ChannelKey key_of(const Json& data, std::size_t row) {
  const auto wavelength = [&](const char* name) -> std::optional<double> {
    const Json::Array& values = values_of(data, name);
    if (values.empty()) return std::nullopt;
    constexpr double nm_per_um = 1000;
    return values[row].number() * (data.at(name).at("unit").string() == "nm" ? 1 : nm_per_um);
  };
  const auto text = [&](const char* name) {
    const Json::Array& values = values_of(data, name);
    return values.empty() ? "" : polarisation(values[row]);
  };
  const Json& own = data.get("adhoc_variables");
  const Json& named = own.is_object() ? own.get("channel") : own;
  return {wavelength("wavelength_i"), wavelength("wavelength_r"), text("polarization_i"), text("polarization_r"),
          named.is_object() && named.at("values")[row].is_string() ? named.at("values")[row].string() : ""};
}

Channel channel_of(const ChannelKey& key) {
  const auto& [in_nm, out_nm, in, out, name] = key;
  Channel channel;
  channel.wavelength_in_nm = in_nm, channel.wavelength_out_nm = out_nm;
  if (!in.empty()) channel.polarisation_in = in;
  if (!out.empty()) channel.polarisation_out = out;
  channel.name = name;
  if (name.empty() && in_nm) {
    append_number(channel.name, *in_nm);
    channel.name += "nm";
    if (out_nm && *out_nm != *in_nm) channel.name += fmt::format("_{}nm", *out_nm);
  }
  if (channel.name.empty()) channel.name = "value";
  if (name.empty())
    for (const std::string& letter : {in, out})
      if (!letter.empty() && letter != "u") channel.name += "_" + letter;
  return channel;
}

Angle angle_of(const Json& data, const char* name, std::size_t row) {
  const double value = values_of(data, name)[row].number();
  return data.at(name).at("unit").string() == "rad" ? radians(value) : degrees(value);
}

/// Columns of the author's own that are the same for all rows of a sample.
void add_extras(const Json& data, const RowSamples& rows, Dataset& out) {
  const Json& own = data.get("adhoc_variables");
  if (!own.is_object()) return;
  std::string dropped;
  for (const auto& [name, variable] : own.members()) {
    const Json::Array& values = variable.at("values").elements();
    std::vector<double> column(out.size(), unknown);
    bool kept = std::all_of(values.begin(), values.end(), [](const Json& value) { return value.is_number(); });
    for (std::size_t row = 0; row < values.size() && kept; ++row) {
      double& at = column[rows.sample_of[row]];
      kept = std::isnan(at) || at == values[row].number();
      at = values[row].number();
    }
    if (kept)
      out.extra[name] = std::move(column);
    else if (name != "channel")
      dropped += (dropped.empty() ? "" : ", ") + name;
  }
  if (!dropped.empty()) out.provenance["dropped_columns"] = dropped;
}

void add_metadata(const Json& document, Dataset& out) {
  const Json& metadata = document.get("metadata");
  if (!metadata.is_object()) return;
  const auto keep = [&](const char* key, const std::string& value) {
    if (!value.empty()) out.provenance[key] = value;
  };
  const auto text = [](const Json& object, const char* key) {
    return object.is_object() && object.get(key).is_string() ? object.at(key).string() : "";
  };
  keep("description", text(metadata, "description"));
  keep("timestamp", text(metadata, "timestamp"));
  keep("organization", text(metadata.get("provenance"), "organization"));
  keep("instrument", text(metadata.get("instrumentation"), "name"));
  keep("sample", text(metadata.get("sample"), "name"));
  keep("bird_metadata", metadata.dump(-1));
  const std::string symmetry = text(metadata.get("sample"), "properties_symmetry");
  out.symmetry.isotropic = symmetry.find("isotropic") != std::string::npos && symmetry.find("anisotropic") == std::string::npos;
  out.symmetry.bilateral = symmetry.find("bilateral") != std::string::npos;
  const Json& own = metadata.get("adhoc_section");
  out.simulated =
      own.is_object() && own.get("simulated").is_bool() ? own.at("simulated").boolean() : text(metadata, "method") == "simulation";
}

/// Raises the faults of the data; gives the first of the metadata and their number in words.
std::string raise_faults_of_data(const Json& document, FaultList& faults) {
  std::size_t n_metadata = 0;
  std::string first;
  for (const Fault& fault : faults_of(document, Schema::bird_brdf, faults.file())) {
    if (fault.where.find("#/metadata") == std::string::npos) {
      faults.add(fault.where, fault.found, fault.wanted);
    } else if (n_metadata++ == 0) {
      first = fault.where.substr(fault.where.find('#')) + ": " + fault.found;
    }
  }
  faults.raise();
  // A text too long for the schema's patterns ends the search before the data are looked at.
  if (n_metadata > 0) {
    Json without = document;
    without.set("metadata", Json::object());
    for (const Fault& fault : faults_of(without, Schema::bird_brdf, faults.file()))
      if (fault.where.find("#/metadata") == std::string::npos) faults.add(fault.where, fault.found, fault.wanted);
    faults.raise();
  }
  return n_metadata == 0 ? "as the public schema wants them" : fmt::format("{} faults, the first {}", n_metadata, first);
}

}  // namespace

Opened open_bird(const std::filesystem::path& path, const ReadOptions& options) {
  const Json document = parse_json(read_file(path), path.string());
  FaultList faults(path.string());
  const std::string metadata = raise_faults_of_data(document, faults);
  const Json& data = document.at("data");
  require_equal_lengths(data, faults);
  faults.raise();
  const double factor = coverage_factor(document, options, faults);
  faults.raise();

  const std::vector<double> u = uncertainties(data, factor);
  // By wavelength; those without one in the order of their first row.
  std::map<ChannelKey, std::size_t> keys;
  std::vector<ChannelKey> order;
  for (std::size_t row = 0; row < u.size(); ++row) {
    const ChannelKey key = key_of(data, row);
    if (keys.emplace(key, 0).second) order.push_back(key);
  }
  std::stable_sort(order.begin(), order.end(), [](const ChannelKey& a, const ChannelKey& b) { return std::get<0>(a) < std::get<0>(b); });
  Channels channels;
  for (const ChannelKey& key : order) {
    keys[key] = channels.size();
    channels.push_back(channel_of(key));
  }
  constexpr std::size_t most_channels = 4096;
  if (channels.size() > most_channels)
    throw Error(ErrorKind::input, {path.string(), fmt::format("{} wavelengths and polarisations", channels.size()), "at most 4096"});

  std::vector<ValueRow> rows;
  for (std::size_t row = 0; row < u.size(); ++row)
    rows.push_back({{angle_of(data, angle_names[0], row), angle_of(data, angle_names[1], row), angle_of(data, angle_names[2], row),
                     angle_of(data, angle_names[3], row)},
                    keys.at(key_of(data, row)),
                    values_of(data, "BRDF")[row].number(),
                    u[row]});
  RowSamples samples = samples_of_rows(rows, std::move(channels));
  add_extras(data, samples, samples.samples);
  add_metadata(document, samples.samples);
  for (const char* name : {"theta_i", "phi_i", "theta_r", "phi_r", "wavelength_i"})
    if (const Json& common = data.get(name).is_object() ? data.at(name).get("uncertainty") : data.get(name); common.is_object())
      samples.samples.provenance[fmt::format("uncertainty_{}", name)] =
          fmt::format("{} {}", common.at("value").number(), common.at("unit").string());

  Opened out = opened_grid("bird-json", std::make_shared<const Dataset>(std::move(samples.samples)));
  const bool known = out.dataset->has_uncertainty();
  out.info.insert(out.info.begin(),
                  {{"holds", "f, cosine not included"},
                   {"unit", "1/sr"},
                   {"nodes", fmt::format("{} rows, one for each direction, wavelength and polarisation", u.size())},
                   {"coverage factor", known ? fmt::format("{}: u is what stands in the file divided by it", factor) : "no uncertainties"},
                   {"metadata", metadata}});
  return out;
}

bool recognises_bird(std::string_view head, std::uintmax_t) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || head[first] != '{') return false;
  const auto has = [&](std::string_view text) { return head.find(text) != std::string_view::npos; };
  if (has("BRDF_JSON_schema")) return true;
  if (has("\"metadata\"") && has("\"timestamp\"") && has("\"provenance\"")) return true;
  return has("\"data\"") && (has("\"theta_i\"") || has("\"BRDF\"") || has("\"wavelength_i\"")) && has("\"unit\"");
}

}  // namespace gonio::tabulated
