// SPDX-License-Identifier: BSD-3-Clause
// Which column of a CSV file means what: from its header row, its own metadata and the options of the caller.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_metadata.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// The four angles, in the order of `GonioAngles`.
constexpr std::array<const char*, 4> angle_names{"theta_i", "phi_i", "theta_o", "phi_o"};
enum AngleIndex : std::size_t { theta_i, phi_i, theta_o, phi_o };

/// Where a number goes.
struct CsvTarget {
  enum class Kind { ignored, angle, channel, uncertainty, wavelength, extra } kind = Kind::ignored;
  std::size_t index = 0;  ///< AngleIndex, channel or position in `CsvLayout::extras`
};

struct CsvLayout {
  std::vector<CsvTarget> columns;  ///< one per column of the file
  struct Constant {
    CsvTarget target;
    double value;
  };
  std::vector<Constant> constants;   ///< what the file has no column for
  std::array<bool, 4> in_radians{};  ///< unit of each angle
  bool azimuths_from_plane = false;  ///< no azimuths: signed zenith angles in one plane
  std::vector<std::string> channels;
  std::vector<std::string> extras;
  std::vector<std::string> left_out;  ///< columns that nothing was made of, by name or as `column NUMBER`
  bool has_uncertainty = false;
  double wavelength_unit_nm = 0;  ///< of the column that says which wavelength a row was measured at; 0: there is none
};

/// `header` has one name per column, or is empty where the file has no header row. Faults are added, never thrown.
///
/// `wavelength_nm` or `wavelength_um` is a column of wavelengths: one row per wavelength, to become one channel each.
/// Without a channel in `options.columns` every column that is no angle, no `u_<channel>` and no known extra is a channel (in a
/// file of ours: those its metadata name). With one, other columns of the file are left out unless their names are reserved.
CsvLayout layout_of(const std::vector<std::string>& header, std::size_t column_count, const ReadOptions& options,
                    const CsvMetadata& metadata, FaultList& faults);

/// True for the names that are never channels: the optional columns (`repeat`, `n`, ... `repeat`, `n`, `time_s`, `range`, `x_mm`,
/// `y_mm`, `c_<name>`, `measured_<angle>`, `var_<name>`).
bool is_extra_name(std::string_view name);
/// Angle and unit if the name is `<angle>_deg` or `<angle>_rad`.
struct NamedAngle {
  std::size_t index;
  bool in_radians;
};
std::optional<NamedAngle> angle_named(std::string_view name);

}  // namespace gonio::tabulated
