// SPDX-License-Identifier: BSD-3-Clause
// Schema, profiles, and the contradictions a schema cannot name.
#include "acquisition/bench_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "acquisition/axis_profile.hpp"
#include "data-schemas/document.hpp"

namespace gonio::acquisition {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// NaN if it is not there or no number; comparisons with it are false, so a check of it stays silent.
double number(const Json& object, std::string_view key) {
  const Json& value = object.get(key);
  return value.is_number() ? value.number() : nan;
}

std::size_t elements(const Json& array) { return array.is_array() ? array.size() : 0; }

double largest(RegisterField::Type type) {
  using enum RegisterField::Type;
  switch (type) {
    case u16: return std::numeric_limits<std::uint16_t>::max();
    case i16: return std::numeric_limits<std::int16_t>::max();
    case u32: return std::numeric_limits<std::uint32_t>::max();
    case i32: break;
  }
  return std::numeric_limits<std::int32_t>::max();
}

bool names_a_file(const Json& profile) { return profile.is_string() && axis_profile_text(profile.string()).empty(); }

std::optional<AxisProfile> profile_of(const Json& axis, const std::string& pointer, const std::filesystem::path& folder,
                                      std::vector<Fault>& faults) {
  const Json& profile = axis.get("profile");
  if (!profile.is_string() && !profile.is_object()) return std::nullopt;
  try {
    return profile.is_string() ? load_axis_profile(profile.string(), folder) : axis_profile_from(profile, "");
  } catch (const Error& error) {
    // Faults of a profile inside the bench file stand in the bench file; those of another file carry its name already.
    for (Fault fault : error.faults()) {
      if (profile.is_object() && fault.where.starts_with('#')) fault.where = pointer + "/profile" + fault.where.substr(1);
      if (profile.is_string()) fault.where = pointer + "/profile: " + fault.where;
      faults.push_back(std::move(fault));
    }
    return std::nullopt;
  }
}

/// The profile has to hold the positions and speeds that the axis asks of it.
void check_range(const Json& axis, const AxisProfile& profile, const std::string& pointer, std::vector<Fault>& faults) {
  const double counts_per_deg = number(axis, "counts_per_deg"), zero = number(axis, "zero_offset_deg");
  for (const char* limit : {"lower_deg", "upper_deg"}) {
    const double position = std::abs(number(axis, limit) - zero) * counts_per_deg / profile.target.scale;
    if (position > largest(profile.target.type))
      faults.push_back({pointer + "/" + limit, fmt::format("{:.0f} counts", position),
                        fmt::format("at most {:.0f}, the largest target of profile {}", largest(profile.target.type), profile.name)});
  }
  const double speed = number(axis, "speed_deg_per_s") * counts_per_deg / profile.velocity.scale;
  if (speed > largest(profile.velocity.type))
    faults.push_back({pointer + "/speed_deg_per_s", fmt::format("{:.0f} counts/s", speed),
                      fmt::format("at most {:.0f}, the largest speed of profile {}", largest(profile.velocity.type), profile.name)});
  if (speed < 0.5)
    faults.push_back({pointer + "/speed_deg_per_s", fmt::format("{:g} counts/s", speed), "at least 1, or the drive stands still"});
  if (std::find(profile.transports.begin(), profile.transports.end(), "modbus-tcp") == profile.transports.end())
    faults.push_back(
        {pointer + "/profile", "a drive without Modbus TCP", "a profile with transport modbus-tcp, which this bench is connected by"});
}

void check_axes(const Json& document, const std::filesystem::path& folder, std::vector<Fault>& faults) {
  const Json& axes = document.get("axes");
  std::map<double, std::size_t> unit_of;
  std::map<std::string, std::size_t> name_of;
  for (std::size_t k = 0; k < elements(axes); ++k) {
    const Json& axis = axes[k];
    if (!axis.is_object()) continue;
    const std::string pointer = fmt::format("/axes/{}", k);
    if (number(axis, "lower_deg") >= number(axis, "upper_deg"))
      faults.push_back({pointer + "/lower_deg", fmt::format("{:g}", number(axis, "lower_deg")),
                        fmt::format("less than upper_deg, {:g}", number(axis, "upper_deg"))});
    if (number(axis, "tolerance_deg") * number(axis, "counts_per_deg") < 0.5)
      faults.push_back(
          {pointer + "/tolerance_deg", fmt::format("{:g}", number(axis, "tolerance_deg")), "at least half a count: nearer it cannot come"});
    if (const double unit = number(axis, "unit"); !std::isnan(unit)) {
      const auto [other, is_new] = unit_of.emplace(unit, k);
      if (!is_new) faults.push_back({pointer + "/unit", fmt::format("{}, the unit of axis {}", unit, other->second), "a unit of its own"});
      if (unit == number(document.get("io"), "unit"))
        faults.push_back({pointer + "/unit", fmt::format("{}, the I/O unit", unit), "a unit of its own"});
    }
    if (const Json& name = axis.get("name"); name.is_string() && !name_of.emplace(name.string(), k).second)
      faults.push_back({pointer + "/name", name.string() + " for the second time", "each axis once"});
    if (const auto profile = profile_of(axis, pointer, folder, faults)) check_range(axis, *profile, pointer, faults);
  }
}

void check_geometry(const Json& document, std::vector<Fault>& faults) {
  const Json& geometry = document.get("geometry");
  const double spot = number(geometry, "spot_diameter_m"), field = number(geometry, "field_diameter_m");
  if (spot > 0 && field <= spot)
    faults.push_back({"/geometry/field_diameter_m", fmt::format("{:g}", field),
                      fmt::format("more than the spot, {:g}: only the spot inside the field is measured", spot)});
  if (number(geometry, "head_radius_m") + number(geometry, "beam_radius_m") >= number(geometry, "detector_distance_m"))
    faults.push_back({"/geometry/head_radius_m", fmt::format("{:g}", number(geometry, "head_radius_m")),
                      "with beam_radius_m, less than detector_distance_m"});
}

void check_simulated(const Json& document, std::vector<Fault>& faults) {
  const Json& simulated = document.get("simulated");
  if (simulated.is_null()) {
    for (const char* device : {"modbus", "scpi"})
      if (number(document.get("connections").get(device), "port") == 0)
        faults.push_back({fmt::format("/connections/{}/port", device), "0", "the port of the device; 0 is for simulated benches"});
    if (number(document.get("reference"), "u_relative") == 0)
      faults.push_back({"/reference/u_relative", "0", "the certificate's uncertainty; 0 is for simulated benches"});
    return;
  }
  const Json& sample = simulated.get("sample");
  if (sample.is_object() && sample.contains("model") == sample.contains("file"))
    faults.push_back(
        {"/simulated/sample", sample.contains("model") ? "both a model and a file" : "neither a model nor a file", "one of the two"});
  if (sample.is_object() && sample.contains("parameters") && !sample.contains("model"))
    faults.push_back({"/simulated/sample/parameters", "parameters without a model", "the model they belong to"});
}

}  // namespace

std::vector<Fault> bench_faults(const Json& document, const std::filesystem::path& folder, const std::string& source) {
  std::vector<Fault> faults;
  check_axes(document, folder, faults);
  check_geometry(document, faults);
  check_simulated(document, faults);
  for (Fault& fault : faults) fault.where = source + "#" + fault.where;
  std::vector<Fault> all = faults_of(document, Schema::bench, source);
  all.insert(all.end(), faults.begin(), faults.end());
  return all;
}

Json self_contained(const Json& document, const std::filesystem::path& folder) {
  Json out = document;
  Json axes = Json::array();
  for (Json axis : document.at("axes").elements()) {
    if (names_a_file(axis.at("profile"))) {
      const std::filesystem::path path = folder / axis.at("profile").string();
      axis.set("profile", parse_json(read_file(path), path.string()));
    }
    axes.push_back(std::move(axis));
  }
  out.set("axes", std::move(axes));
  if (Json simulated = document.get("simulated"); !simulated.get("sample").get("file").is_null()) {
    Json sample = simulated.at("sample");
    sample.set("file", std::filesystem::absolute(folder / sample.at("file").string()).lexically_normal().string());
    simulated.set("sample", std::move(sample));
    out.set("simulated", std::move(simulated));
  }
  return out;
}

}  // namespace gonio::acquisition
