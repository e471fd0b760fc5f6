// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/open.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "brdf/error.hpp"
#include "tabulated/formats/abg.hpp"
#include "tabulated/formats/alta.hpp"
#include "tabulated/formats/astm.hpp"
#include "tabulated/formats/bird.hpp"
#include "tabulated/formats/brdf_exr.hpp"
#include "tabulated/formats/cornell.hpp"
#include "tabulated/formats/csv.hpp"
#include "tabulated/formats/exr_atlas.hpp"
#include "tabulated/formats/fit_json.hpp"
#include "tabulated/formats/fred.hpp"
#include "tabulated/formats/lab_csv.hpp"
#include "tabulated/formats/lighttools.hpp"
#include "tabulated/formats/mbsdf.hpp"
#include "tabulated/formats/merl.hpp"
#include "tabulated/formats/openmaterial.hpp"
#include "tabulated/formats/pab.hpp"
#include "tabulated/formats/radiance_xml.hpp"
#include "tabulated/formats/rgl.hpp"
#include "tabulated/formats/speos.hpp"
#include "tabulated/formats/ssdd.hpp"
#include "tabulated/formats/tracepro.hpp"
#include "tabulated/formats/utia.hpp"
#include "tabulated/formats/zemax.hpp"
#include "tabulated/samples_to_write.hpp"

namespace gonio::tabulated {
namespace {

/// Enough to recognise any format.
constexpr std::size_t head_size = 4096;

ExportNotes write_samples_as_csv(const Opened& opened, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  write_csv(*samples_to_write(opened, options, notes), path);
  notes.files = {path};
  return notes;
}

ExportNotes write_samples_as_exr(const Opened& opened, const std::filesystem::path& path, const WriteOptions& options) {
  ExportNotes notes;
  const SampleTable table = tabulate(*samples_to_write(opened, options, notes));
  write_brdf_exr(table, path);
  notes.files = {path};
  notes.n_nodes = table.cell_count(), notes.n_unknown = 0;
  for (std::size_t cell = 0; cell < table.cell_count(); ++cell) notes.n_unknown += table.is_empty(cell) ? 1 : 0;
  notes.facts.emplace_back("table", fmt::format("{} incident x {} outgoing directions", table.incident.size(), table.outgoing.size()));
  if (notes.n_unknown > 0) notes.lost.emplace_back("directions without a sample are NaN");
  for (const std::string& column : table.dropped_columns)
    notes.lost.push_back(fmt::format("the column {} has no place in a table", column));
  return notes;
}

std::string known_formats() {
  std::string out;
  for (const Format& format : formats())
    if (format.open) out += (out.empty() ? "" : ", ") + std::string(format.name);
  return out;
}

Opened open_as(const Format& format, const std::filesystem::path& path, const ReadOptions& options) {
  std::string known;
  for (const char* key : format.assumptions) known += (known.empty() ? "" : ", ") + std::string(key);
  std::vector<Fault> faults;
  for (const auto& [key, answer] : options.assume)
    if (std::find(format.assumptions.begin(), format.assumptions.end(), key) == format.assumptions.end())
      faults.push_back({"--assume " + key, fmt::format("an answer to what {} never asks", format.name),
                        known.empty() ? "no --assume: such files say all that is needed" : "one of " + known});
  if (!faults.empty()) throw Error(ErrorKind::usage, "assumptions that do not fit the file", faults);
  return format.open(path, options);
}

std::string head_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(head_size, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!file && !file.eof()) throw Error(ErrorKind::input, {path.string(), "a file that cannot be read", "a readable file"});
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

}  // namespace

std::optional<std::string> ReadOptions::assumed(const std::string& key) const {
  const auto answer = assume.find(key);
  return answer == assume.end() ? std::nullopt : std::optional(answer->second);
}

const std::vector<Format>& formats() {
  // In the order of recognition: text comes last because anything readable could be it.
  static const std::vector<Format> list{
      {"merl", "90 x 90 x 180 half/difference table of red, green, blue (.binary)", recognises_merl, open_merl, write_merl, ".binary"},
      {"utia",
       "anisotropic table of the UTIA database, 288 x 288 x 3 numbers (.bin)",
       recognises_utia,
       open_utia,
       write_utia,
       ".bin",
       false,
       {"values"}},
      {"utia-display", "the same as codes for display (write only)", nullptr, nullptr, write_utia_display, ".bin"},
      {"utia-exr",
       "the same as an OpenEXR picture of 288 x 288 pixels (.exr)",
       recognises_utia_exr,
       open_utia_exr,
       write_utia_exr,
       ".exr",
       false,
       {"values"}},
      {"exr-atlas", "isotropic table as an OpenEXR picture: tiles phi_d, right theta_h, down theta_d", recognises_exr_atlas, open_exr_atlas,
       write_exr_atlas, ".exr"},
      {"exr-atlas-spherical", "the same with tiles of azimuth, right theta_i, down theta_o (write only)", nullptr, nullptr,
       write_exr_atlas_spherical, ".exr"},
      {"exr-slice", "picture of the slice phi_d = 90 deg, theta_h right, theta_d up (write only)", nullptr, nullptr, write_exr_slice,
       ".exr"},
      {"brdf-exr",
       "table of incident by outgoing directions as an OpenEXR file (.brdf.exr)",
       recognises_brdf_exr,
       open_brdf_exr,
       write_samples_as_exr,
       ".brdf.exr",
       false,
       {},
       true},
      {"mbsdf",
       "measured isotropic BSDF of NVIDIA's Material Definition Language (.mbsdf)",
       recognises_mbsdf,
       open_mbsdf,
       write_mbsdf,
       ".mbsdf",
       false,
       {"nodes", "part"}},
      {"bird-json",
       "rows of f with uncertainties in the universal BRDF data format of the BiRD project (JSON)",
       recognises_bird,
       open_bird,
       write_bird,
       ".json",
       false,
       {"coverage_factor"},
       true},
      {"openmaterial-json",
       "look-up table of an isotropic BRDF of ASAM OpenMATERIAL 3D (JSON, _brdf.xompt)",
       recognises_openmaterial,
       open_openmaterial,
       write_openmaterial,
       ".xompt",
       false,
       {"specular_azimuth_deg"},
       true},
      {"rgl", "material file of the RGL database, RGB or spectral; written as RGB (.bsdf)", recognises_rgl, open_rgl, write_rgl_rgb,
       ".bsdf", true},
      {"rgl-spectral", "the same with a spectrum for every pair (write only)", nullptr, nullptr, write_rgl_spectral, ".bsdf", true},
      {"radiance-xml",
       "BSDF of WINDOW or Radiance as XML, matrix or tensor tree (read only; written as radiance-klems-..., radiance-tree...)",
       recognises_radiance_xml,
       open_radiance_xml,
       nullptr,
       "",
       false,
       {"kind", "side", "wavelength"}},
      {"radiance-klems-full", "XML of Radiance and WINDOW: 145 x 145 Klems patches", nullptr, nullptr, write_radiance_klems_full, ".xml"},
      {"radiance-klems-half", "XML of Radiance and WINDOW: 77 x 77 Klems patches", nullptr, nullptr, write_radiance_klems_half, ".xml"},
      {"radiance-klems-quarter", "XML of Radiance and WINDOW: 41 x 41 Klems patches", nullptr, nullptr, write_radiance_klems_quarter,
       ".xml"},
      {"radiance-tree3", "XML of Radiance: tensor tree of an isotropic BRDF", nullptr, nullptr, write_radiance_tree3, ".xml", true},
      {"radiance-tree4", "XML of Radiance: tensor tree of any BRDF", nullptr, nullptr, write_radiance_tree4, ".xml", true},
      {"fit-json", "the document of a fit, as the model it describes (read only)", recognises_fit_json, open_fit_json},
      {"zemax",
       "tabular scatter file of OpticStudio, angles about the specular direction (.bsdf)",
       recognises_zemax,
       open_zemax,
       write_zemax,
       ".bsdf",
       false,
       {"rotation", "wavelength_nm"}},
      {"zemax-set", "the same as a monochrome file for each channel, NAME-CHANNEL.bsdf", nullptr, nullptr, write_zemax_set, ".bsdf"},
      {"lighttools",
       "tabular scatter file of LightTools, absolute angles (.bsdf; writer untested with the program itself)",
       recognises_lighttools,
       open_lighttools,
       write_lighttools,
       ".bsdf",
       false,
       {"side", "scatter"}},
      {"speos",
       "scatter file of Ansys SPEOS as text (.brdf, .anisotropicbsdf; .brdf written, untested with the program itself)",
       recognises_speos,
       open_speos,
       write_speos,
       ".brdf",
       false,
       {"scale", "scatter", "rotation"}},
      {"tracepro",
       "table of scatter in a surface property of TracePro (.txt; writer untested with the program itself)",
       recognises_tracepro,
       open_tracepro,
       write_tracepro,
       ".txt",
       false,
       {"scatter", "zero_azimuth"}},
      {"fred",
       "tabulated scatter of FRED, named by the specular direction (.txt)",
       recognises_fred,
       open_fred,
       write_fred,
       ".txt",
       false,
       {"side"},
       true},
      {"abg", "parameters of the ABg model by incidence, for OpticStudio and FRED (.abg)", recognises_abg, open_abg, write_abg, ".abg"},
      {"ssdd",
       "surface scattering distribution data, half-difference coordinates, text (.ssdd)",
       recognises_ssdd,
       open_ssdd,
       write_ssdd,
       ".ssdd",
       false,
       {"data_type"}},
      {"ssdd-binary", "the same with binary numbers", nullptr, nullptr, write_ssdd_binary, ".ssdd"},
      {"ssdd-spherical", "the same in spherical coordinates", nullptr, nullptr, write_ssdd_spherical, ".ssdd"},
      {"ssdd-specular", "the same in coordinates about the specular direction", nullptr, nullptr, write_ssdd_specular, ".ssdd"},
      {"ssdd-distorted", "the same in polar coordinates between the specular direction and the horizon", nullptr, nullptr,
       write_ssdd_distorted, ".ssdd"},
      {"alta",
       "samples as text of the ALTA library, with its #DIM and #PARAM lines",
       recognises_alta,
       open_alta,
       write_alta,
       ".alta",
       false,
       {"theta_d_deg", "phi_d_deg"},
       true},
      {"alta-half",
       "the same by half and difference angles, isotropic (write only)",
       nullptr,
       nullptr,
       write_alta_half,
       ".alta",
       false,
       {},
       true},
      {"rt300s",
       "readings of an RT-300S as CSV, relative to a white (read only)",
       recognises_rt300s,
       open_rt300s,
       nullptr,
       "",
       false,
       {"white", "blocked", "isotropic"}},
      {"nist",
       "Mueller matrix BRDF of NIST as CSV, its unpolarised element (read only)",
       recognises_nist,
       open_nist,
       nullptr,
       "",
       false,
       {"isotropic"}},
      {"cornell",
       "spectral samples of Cornell University (.brdf, read only)",
       recognises_cornell,
       open_cornell,
       nullptr,
       "",
       false,
       {"isotropic"}},
      {"astm",
       "samples as ASTM E1392 and E2387 list them (.astm)",
       recognises_astm,
       open_astm,
       write_astm,
       ".astm",
       false,
       {"specular", "side", "isotropic"},
       true},
      {"pab",
       "measurements of pab's goniophotometers, one incidence a file, as Radiance's pabopto2bsdf takes them (.dat)",
       recognises_pab,
       open_pab,
       write_pab,
       ".dat",
       false,
       {"side"},
       true},
      {"csv",
       "samples as text: theta_i_deg, phi_i_deg, theta_o_deg, phi_o_deg, values and uncertainties",
       recognises_csv,
       open_csv,
       write_samples_as_csv,
       ".csv",
       false,
       {},
       true},
  };
  return list;
}

Opened open_brdf(const std::filesystem::path& path, const ReadOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw Error(ErrorKind::input, {path.string(), std::filesystem::exists(path, error) ? "something that is not a file" : "no such file",
                                   "a file that holds a BRDF"});
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw Error(ErrorKind::input, {path.string(), error.message(), "a readable file"});

  const std::vector<Format>& list = formats();
  if (options.format) {
    const auto named =
        std::find_if(list.begin(), list.end(), [&](const Format& format) { return format.open && *options.format == format.name; });
    if (named == list.end()) throw Error(ErrorKind::usage, {"--format", *options.format, "one of " + known_formats()});
    return open_as(*named, path, options);
  }
  const std::string head = head_of(path);
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const Format& format) { return format.recognises && format.recognises(head, size); });
  if (found == list.end())
    throw Error(ErrorKind::input, {path.string(), size == 0 ? "an empty file" : fmt::format("{} bytes of an unknown kind", size),
                                   "one of " + known_formats()});
  return open_as(*found, path, options);
}

}  // namespace gonio::tabulated
