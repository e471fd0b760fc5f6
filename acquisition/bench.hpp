// SPDX-License-Identifier: BSD-3-Clause
// The bench file: what the instrument is made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/axis_profile.hpp"
#include "acquisition/pose.hpp"
#include "brdf/channels.hpp"
#include "brdf/dataset.hpp"
#include "data-schemas/json.hpp"

namespace gonio::acquisition {

/// One driven axis. Angles are axis angles in degrees; position = round((angle - zero) · sign · counts_per_deg).
struct Axis {
  std::string name;
  AxisProfile profile;
  int unit = 1;  ///< Modbus unit id
  double counts_per_deg = 1e6;
  double zero_offset_deg = 0;
  int sign = 1;
  double lower_deg = -180, upper_deg = 180;  ///< limits, inclusive
  double speed_deg_per_s = 30, acceleration_deg_per_s2 = 60;
  double tolerance_deg = 0.01;  ///< in position when the read-back is this near
  double settle_s = 0.1;

  /// The position nearest to an axis angle. The angle has to be within the limits: then the position fits the target register.
  std::int64_t counts(double angle_deg) const;
  /// The axis angle of a position; `degrees(counts(a))` is a to half a count.
  double degrees(std::int64_t position) const;
};

struct Endpoint {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0 only for an embedded bench
};

/// What one reading of the meter is uncertain by, as the lab states it (k = 1). All parts are added in squares.
struct MeterNoise {
  std::optional<double> read_w;               ///< standard deviation of one reading in the dark [W]
  std::optional<double> electrons_per_joule;  ///< photo-electrons per joule of light: shot variance of a reading = S / (k t) [W²]
  int digits = 17;                            ///< significant digits the meter prints: a rectangular width of one last digit
};

/// The white reference: a certified BRDF value in one pose.
struct Reference {
  std::string name;
  Pose pose;
  double f_per_sr = 0;      ///< certified f at that pose [1/sr]
  double u_relative = 0;    ///< relative standard uncertainty of the certificate, k = 1
  double interval_s = 600;  ///< bench time between reference readings
  int readings = 1;         ///< readings taken at each visit
};

/// What lies on the sample holder of a simulated bench: a model by name with its parameters, or a BRDF file.
struct SimulatedSample {
  std::string model;
  std::map<std::string, double> parameters;
  std::filesystem::path file;  ///< resolved against the folder of the bench file; empty if `model` is given
};

/// Requests for the simulated bench; each effect is on only if the file names it.
struct SimulatedEffects {
  bool motion = false;                         ///< axes take time: speed and acceleration of the axis
  std::optional<double> shot_counts_per_unit;  ///< photo-electrons per joule: variance of a reading = S / (k t) [W²]
  std::optional<double> read_noise;            ///< standard deviation of one reading [W]
  std::optional<double> dark;                  ///< dark signal [W]
  std::optional<double> drift_per_hour;        ///< relative change of the source per hour
  bool certificate_error = false;              ///< the true white differs from the certificate by one draw of its uncertainty
  int meter_digits = 17;                       ///< significant digits the meter prints
  std::optional<SimulatedSample> sample;
};

struct Bench {
  std::string name;
  std::string kinematics;  ///< name in the list of kinematics, e.g. "spherical-gantry"
  double bottom_stay_out_deg = 10;
  std::vector<Axis> axes;
  Endpoint modbus, scpi;
  int io_unit = 10;                 ///< Modbus unit of shutter and sample slide
  std::string expected_idn;         ///< the detector's `*IDN?` has to start with this
  double exposure_s = 0.1;          ///< of reference readings, and of sample readings unless the plan says otherwise
  double range_w = 1e-3;            ///< fixed range (`SENS:POW:RANG:UPP`)
  std::optional<MeterNoise> noise;  ///< none: `reduce` estimates it from repeated readings
  double source_power_w = 1e-3, wavelength_nm = 550;
  std::optional<double> bandwidth_nm;
  std::optional<std::string> polarisation_source, polarisation_receiver;
  double detector_distance_m = 0.8, head_radius_m = 0.03, beam_radius_m = 0.005, shadow_margin_deg = 0.5;
  Apertures apertures;  ///< all four stated
  double dark_interval_s = 600;
  int dark_readings = 1;  ///< readings taken at each dark step
  Reference reference;
  std::map<std::string, double> correlated;  ///< named components of uncertainty stated by the lab, relative, k = 1
  SimulatedEffects simulated;
  bool is_simulated = false;
  std::uint64_t seed = 1;

  Json document;       ///< the file as it was read
  std::string sha256;  ///< of the file; of `document.dump()` if it was no file
};

/// Reads and validates a bench file (axis profiles are paths relative to it or built-in names). Error(input) with all faults.
Bench load_bench(const std::filesystem::path& path);
/// From a document; validates it too. `folder` resolves relative paths, `source` names the document in faults.
Bench bench_from(const Json& document, const std::filesystem::path& folder, const std::string& source = "bench");

}  // namespace gonio::acquisition
