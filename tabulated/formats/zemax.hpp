// SPDX-License-Identifier: BSD-3-Clause
// Tabular scatter files of Zemax OpticStudio (.bsdf).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tabulated/open.hpp"
#include "tabulated/specular_table.hpp"

namespace gonio::tabulated {

/// What a Zemax file says beside its values.
struct ZemaxRemarks {
  std::vector<std::string> comments;     ///< without their `#`
  std::vector<std::vector<double>> tis;  ///< [channel][rotation · incidences + incidence]
};

/// A table as a Zemax file holds it.
class ZemaxTable final : public SpecularTable {
 public:
  ZemaxTable(SpecularGrid grid, Channels channels, std::vector<std::vector<double>> values, ZemaxRemarks remarks)
      : SpecularTable(std::move(grid), std::move(channels), std::move(values)), remarks_(std::move(remarks)) {}
  const ZemaxRemarks& remarks() const noexcept { return remarks_; }

 private:
  ZemaxRemarks remarks_;
};

/// The comment by which files of ours say how their sample rotations turn; without the `#`.
constexpr std::string_view zemax_rotation_comment = " the azimuth of the light is 270 degrees + SampleRotation, counter-clockwise";
/// A comment with a number behind it.
constexpr std::string_view zemax_wavelength_comment = "Wavelength (nm) = ";

/// f [1/sr] on angles about the specular direction (SpecularAngles); `Symmetry` PlaneSymmetrical (azimuths 0 … 180° stand for both
/// sides), ASymmetrical, ASymmetrical4D (with sample rotations); channel `value`, or X, Y, Z. With several sample rotations the file does
/// not say in which sense they turn: `--assume rotation=counter-clockwise|clockwise`, the azimuth of the light being 270° ± rotation
/// (files of ours say it). `--assume wavelength_nm=NUMBER` names the wavelength, which
/// files say in a comment at most.
/// A file that is one of a set, a channel each (zemax_set.hpp), is read with the others.
/// Trap: `TIS` is what the author of the file computed; it scales what OpticStudio scatters, and some leave out cos theta_o.
/// Throws Error(input) with all faults.
std::shared_ptr<const ZemaxTable> read_zemax(const std::filesystem::path& path, const ReadOptions& options);

bool recognises_zemax(std::string_view head, std::uintmax_t size);
Opened open_zemax(const std::filesystem::path& path, const ReadOptions& options);

/// A source that is a Zemax table is written with its own grid, values, TIS and comments. Anything else is evaluated at incidences
/// 0 … 89° (9, 18 or 45 of them: paper, standard, fine), azimuths in steps of 15, 10 or 5°, and 32, 64 or 128 radial angles, chosen where
/// straight lines between nodes err most. TIS is `total_scatter` of the source. Nodes beyond the horizon are 0; so are unknown and
/// negative values.
ExportNotes write_zemax(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);
/// A monochrome file for each channel of the source, as it is: NAME-CHANNEL.bsdf (tabulated/formats/zemax_set.hpp); a source of one channel
/// as above.
ExportNotes write_zemax_set(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
