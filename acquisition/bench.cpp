// SPDX-License-Identifier: BSD-3-Clause
// Reading a bench file.
#include "acquisition/bench.hpp"

#include <cmath>

#include "acquisition/bench_faults.hpp"
#include "acquisition/kinematics.hpp"
#include "brdf/error.hpp"
#include "data-schemas/document.hpp"

namespace gonio::acquisition {
namespace {

int integer(const Json& value) { return static_cast<int>(value.number()); }

std::optional<double> optional_number(const Json& object, std::string_view key) {
  const Json& value = object.get(key);
  return value.is_null() ? std::nullopt : std::optional(value.number());
}

std::optional<std::string> optional_text(const Json& object, std::string_view key) {
  const Json& value = object.get(key);
  return value.is_null() ? std::nullopt : std::optional(value.string());
}

Endpoint endpoint(const Json& json) { return {json.at("host").string(), integer(json.at("port"))}; }

Axis axis(const Json& json, const std::filesystem::path& folder) {
  Axis a;
  a.name = json.at("name").string();
  const Json& profile = json.at("profile");
  a.profile = profile.is_string() ? load_axis_profile(profile.string(), folder) : axis_profile_from(profile);
  a.unit = integer(json.at("unit"));
  a.counts_per_deg = json.at("counts_per_deg").number();
  a.zero_offset_deg = json.at("zero_offset_deg").number();
  a.sign = integer(json.at("sign"));
  a.lower_deg = json.at("lower_deg").number();
  a.upper_deg = json.at("upper_deg").number();
  a.speed_deg_per_s = json.at("speed_deg_per_s").number();
  a.acceleration_deg_per_s2 = json.at("acceleration_deg_per_s2").number();
  a.tolerance_deg = json.at("tolerance_deg").number();
  a.settle_s = json.at("settle_s").number();
  return a;
}

Reference reference(const Json& json) {
  const Json& pose = json.at("pose");
  Reference r;
  r.name = json.at("name").string();
  r.pose = {degrees(pose.at("theta_i_deg").number()), degrees(pose.at("phi_i_deg").number()), degrees(pose.at("theta_o_deg").number()),
            degrees(pose.at("phi_o_deg").number())};
  r.f_per_sr = json.at("f_per_sr").number();
  r.u_relative = json.at("u_relative").number();
  r.interval_s = json.at("interval_s").number();
  r.readings = integer(json.at("readings"));
  return r;
}

SimulatedEffects simulated_effects(const Json& json, const std::filesystem::path& folder) {
  const Json& effects = json.at("effects");
  SimulatedEffects s;
  s.motion = effects.boolean_or("motion", false);
  s.shot_counts_per_unit = optional_number(effects, "shot_electrons_per_joule");
  s.read_noise = optional_number(effects, "read_noise_w");
  s.dark = optional_number(effects, "dark_w");
  s.drift_per_hour = optional_number(effects, "drift_per_hour");
  s.certificate_error = effects.boolean_or("certificate_error", false);
  s.meter_digits = static_cast<int>(effects.number_or("meter_digits", s.meter_digits));
  if (const Json& sample = json.get("sample"); !sample.is_null()) {
    SimulatedSample on_holder;
    on_holder.model = sample.string_or("model", "");
    if (const Json& parameters = sample.get("parameters"); !parameters.is_null())
      for (const auto& [name, value] : parameters.members()) on_holder.parameters[name] = value.number();
    if (sample.contains("file")) on_holder.file = folder / sample.at("file").string();
    s.sample = std::move(on_holder);
  }
  return s;
}

/// From a document without faults.
Bench read(const Json& document, const std::filesystem::path& folder) {
  Bench b;
  b.name = document.at("name").string();
  const Json& kinematics = document.at("kinematics");
  b.kinematics = kinematics.at("type").string();
  b.bottom_stay_out_deg = kinematics.at("bottom_stay_out_deg").number();
  b.shadow_margin_deg = kinematics.at("shadow_margin_deg").number();
  for (const Json& a : document.at("axes").elements()) b.axes.push_back(axis(a, folder));
  b.modbus = endpoint(document.at("connections").at("modbus"));
  b.scpi = endpoint(document.at("connections").at("scpi"));
  b.io_unit = integer(document.at("io").at("unit"));
  const Json& source = document.at("source");
  b.source_power_w = source.at("power_w").number();
  b.wavelength_nm = source.at("wavelength_nm").number();
  b.bandwidth_nm = optional_number(source, "bandwidth_nm");
  b.polarisation_source = optional_text(source, "polarisation");
  const Json& detector = document.at("detector");
  b.expected_idn = detector.at("expected_idn").string();
  b.exposure_s = detector.at("exposure_s").number();
  b.range_w = detector.at("range_w").number();
  b.polarisation_receiver = optional_text(detector, "polarisation");
  if (const Json& noise = detector.get("noise"); !noise.is_null())
    b.noise = MeterNoise{optional_number(noise, "read_w"), optional_number(noise, "electrons_per_joule"), integer(noise.at("digits"))};
  const Json& geometry = document.at("geometry");
  b.detector_distance_m = geometry.at("detector_distance_m").number();
  b.head_radius_m = geometry.at("head_radius_m").number();
  b.beam_radius_m = geometry.at("beam_radius_m").number();
  b.apertures = {geometry.at("source_half_angle_deg").number(), geometry.at("receiver_half_angle_deg").number(),
                 geometry.at("spot_diameter_m").number(), geometry.at("field_diameter_m").number()};
  b.reference = reference(document.at("reference"));
  b.dark_interval_s = document.at("dark").at("interval_s").number();
  b.dark_readings = integer(document.at("dark").at("readings"));
  for (const auto& [name, u] : document.at("uncertainty").at("components").members()) b.correlated[name] = u.number();
  if (const Json& simulated = document.get("simulated"); !simulated.is_null()) {
    b.is_simulated = true;
    b.seed = static_cast<std::uint64_t>(simulated.at("seed").number());
    b.simulated = simulated_effects(simulated, folder);
  }
  return b;
}

/// The axes have to make the kinematics, and the reference has to be a pose that this bench can measure.
void require_kinematics(const Bench& bench, const std::string& source) {
  std::unique_ptr<Kinematics> kinematics;
  try {
    kinematics = make_kinematics(bench);
  } catch (const Error& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) fault.where = source + "#" + fault.where;
    throw Error(error.kind(), error.message(), std::move(faults));
  }
  const Pose& pose = bench.reference.pose;
  std::string reason = kinematics->masked(pose).value_or("");
  if (reason.empty() && kinematics->solutions(pose).empty()) reason = kinematics->unreachable_reason(pose);
  if (!reason.empty())
    throw Error(ErrorKind::input, "the bench cannot measure its reference",
                {{source + "#/reference/pose", reason, "a pose of this bench"}});
}

}  // namespace

std::int64_t Axis::counts(double angle_deg) const {
  return std::llround((angle_deg - zero_offset_deg) * sign * counts_per_deg / profile.target.scale);
}

double Axis::degrees(std::int64_t position) const {
  return static_cast<double>(position) * profile.position.scale / counts_per_deg * sign + zero_offset_deg;
}

Bench bench_from(const Json& document, const std::filesystem::path& folder, const std::string& source) {
  if (std::vector<Fault> faults = bench_faults(document, folder, source); !faults.empty())
    throw Error(ErrorKind::input, "the bench file cannot be used", std::move(faults));
  Bench bench = read(document, folder);
  require_kinematics(bench, source);
  bench.document = self_contained(document, folder);
  bench.sha256 = sha256(document.dump());
  return bench;
}

Bench load_bench(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  Bench bench = bench_from(parse_json(text, path.string()), path.parent_path(), path.string());
  bench.sha256 = sha256(text);
  return bench;
}

}  // namespace gonio::acquisition
