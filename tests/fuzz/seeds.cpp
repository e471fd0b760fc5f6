// SPDX-License-Identifier: BSD-3-Clause
// `fuzz_seeds DIR` writes a seed corpus: DIR/READER/WRITER-SOURCE for every writer and a few small sources, put where the reader that
// recognises the file looks for it; `fuzz_reader` starts from them. For formats that are only read, the fewest lines that make a file.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "brdf/analytic_brdf.hpp"
#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "tabulated/open.hpp"
#include "tabulated/opened_samples.hpp"
#include "tabulated/rgl_table.hpp"

namespace fs = std::filesystem;
using namespace gonio;
using namespace gonio::tabulated;

namespace {

/// The largest input that tools/fuzz makes. What is larger cannot be a seed, for its start alone is no file; only the formats of one
/// size, which the fuzzer fills up with zeros, are cut.
constexpr std::uintmax_t largest_seed = 1 << 16;
constexpr const char* of_one_size[] = {"merl", "utia"};

Dataset few_samples(Channels channels, bool in_plane) {
  Dataset out;
  out.channels = std::move(channels);
  out.symmetry.isotropic = true;
  for (const double theta_i : {0.0, 30.0, 60.0})
    for (const double theta_o : {0.0, 25.0, 50.0, 75.0})
      for (const double phi_o : in_plane ? std::vector{0.0, 180.0} : std::vector{0.0, 60.0, 120.0, 180.0, 240.0, 300.0})
        out.angles.push_back({degrees(theta_i), degrees(0), degrees(theta_o), degrees(phi_o)});
  for (std::size_t c = 0; c < out.channels.size(); ++c) {
    out.f.emplace_back(), out.u.emplace_back();
    for (std::size_t k = 0; k < out.angles.size(); ++k) {
      out.f.back().push_back(0.1 + 0.01 * static_cast<double>(k % 7) + 0.02 * static_cast<double>(c));
      out.u.back().push_back(0.003);
    }
  }
  return out;
}

Opened samples(Channels channels, bool in_plane) {
  return opened_samples("csv", std::make_shared<const Dataset>(few_samples(std::move(channels), in_plane)));
}

Opened model(Channels channels) {
  Opened out;
  out.format = "model";
  std::vector<std::vector<double>> parameters(channels.size(), {0.1, 0.2, 20});
  out.brdf = std::make_shared<const AnalyticBrdf>("blinn-phong", std::move(channels), std::move(parameters));
  return out;
}

Channels spectral() {
  Channels out;
  for (const double wavelength_nm : {450.0, 550.0, 650.0}) {
    out.push_back(single_channel(fmt::format("{}nm", wavelength_nm)).front());
    out.back().wavelength_in_nm = out.back().wavelength_out_nm = wavelength_nm;
  }
  return out;
}

/// A material file of a few nodes, which the writer of such files hands on as it is.
Opened small_rgl(Channels channels) {
  RglArrays arrays;
  arrays.phi_i = {0}, arrays.theta_i = {0, 1.5f};
  arrays.angle_rows = 2, arrays.angle_columns = 3;
  arrays.ndf = {1, 0.5f, 0.1f, 1, 0.5f, 0.1f};
  arrays.sigma = {1, 0.9f, 0.7f, 1, 0.9f, 0.7f};
  arrays.vndf_rows = arrays.vndf_columns = arrays.value_rows = arrays.value_columns = 2;
  arrays.vndf = {1, 2, 2, 1, 1, 1, 2, 2};
  arrays.luminance = {1, 1, 1, 1, 1, 1, 1, 1};
  for (std::size_t k = 0; k < 8 * channels.size(); ++k) arrays.values.push_back(0.1f + 0.01f * static_cast<float>(k));
  arrays.channels = std::move(channels);
  Opened out;
  out.format = "rgl";
  out.brdf = std::make_shared<const RglTable>(std::move(arrays));
  return out;
}

Opened matt(Channels channels) {
  std::vector<std::vector<double>> albedo;
  while (albedo.size() < channels.size()) albedo.push_back({0.5 - 0.1 * static_cast<double>(albedo.size())});
  Opened out;
  out.format = "model";
  out.brdf = std::make_shared<const AnalyticBrdf>("lambert", std::move(channels), std::move(albedo));
  return out;
}

std::string mbsdf() {
  std::string out = "NVIDIA ARC MBSDF V1\nversion=\"1\"\nMBSDF_DATA=\n";
  for (const std::uint32_t number : {0u, 2u, 3u}) out.append(reinterpret_cast<const char*>(&number), sizeof number);
  for (int k = 0; k < 12; ++k) {
    const float value = 0.1f * static_cast<float>(k);
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return out;
}

/// Files of formats that no writer makes, or makes small.
const std::vector<std::pair<const char*, std::string>>& by_hand() {
  static const std::vector<std::pair<const char*, std::string>> files{
      {"cornell",
       "# Somebody\n# Paint\n\n# num wls\n2\n\n# wls\n400 500\n\n# theta i, phi i, theta s, phi_s, spectral sample values\n\n"
       "0.5 0.0 0.4 3.0 0.02 0.01\n0.5 0.0 0.2 1.0 0.03 0.02\n"},
      {"mbsdf", mbsdf()},
      {"nist", "lambda,thetai,phi,thetar,phir,f_r11,f_r12/f_r11\n0.351,-30,0,30,0,2.5E-01,0.01\n0.532,-30,0,30,0,3.5E-01,0.01\n"},
      {"rt300s", "sheet,azimuth_deg,incidence_deg,receive_deg,RT\nA,-90.0,30.0,60.0,0.5\nA,0.0,30.0,-30.0,0.2\n"},
      {"alta", "#DIM 4 1\n#PARAM_IN SPHERICAL_TL_PL_TV_PV\n#PARAM_OUT INV_STERADIAN\n0.1 0 0.2 3 0.5\n0.3 0 0.2 1 0.4\n"},
      {"lighttools",
       "Symmetry PlaneSymmetrical\nSpectralContent Monochrome\nScatterAzimuth 3\n0 90 180\nScatterRadial 2\n0 60\nDataBegin\n"
       "AOI 0\nPOI 0\nSide Front\nWavelength 550\nScatterType BRDF\nTIS 0.5\n0.1 0.1\n0.1 0.1\n0.1 0.1\n"
       "AOI 40\nPOI 0\nSide Front\nWavelength 550\nScatterType BRDF\nTIS 0.5\n0.1 0.2\n0.1 0.1\n0.1 0.1\nDataEnd\n"},
      {"lighttools",
       "Symmetry Asymmetric\nSpectralContent XYZ\nScatterAzimuth 2\n0 180\nScatterRadial 2\n0 60\nDataBegin\n"
       "AOI 180\nPOI 0\nSide Back\nScatterType BTDF\nTristimulusValue TrisX\nTIS 0.5\n0.1 0.1\n0.1 0.1\n"
       "AOI 180\nPOI 0\nSide Back\nScatterType BTDF\nTristimulusValue TrisY\nTIS 0.5\n0.1 0.1\n0.1 0.1\n"
       "AOI 180\nPOI 0\nSide Back\nScatterType BTDF\nTristimulusValue TrisZ\nTIS 0.5\n0.1 0.1\n0.1 0.1\nDataEnd\n"},
      {"tracepro",
       "TracePro Surface Property Data\nDescription\tzero azimuth of scatter across the plane of incidence\nTable_BSDF_Data\n"
       "Temperature\tWavelength\tIncAngle\tAziAngle\tScatterBeta\tScatterAzimuth\tBRDF\tBTDF\n"
       "300\t0.55\t0\t0\t0\t0\t0.1\t0\n300\t0.55\t0\t0\t0.5\t0\t0.1\t0\n300\t0.55\t0\t0\t0.5\t120\t0.1\t0.2\n"
       "300\t0.55\t30\t0\t0\t0\t0.2\t0\n300\t0.55\t30\t0\t0.4\t0\t0.1\t0\n300\t0.55\t30\t0\t0.4\t120\t0.1\t0.1\n"},
      {"tracepro",
       "TracePro Surface Property Data\nTable_BSDF_Data\nTemperature Wavelength IncAngle AziAngle ScatterBeta ScatterAzimuth BRDF BTDF\n"
       "300 0.55 0 0 0 0 0.1 0\n300 0.55 0 0 0.5 0 0.1 0\n300 0.65 0 0 0 0 0.2 0\n300 0.65 0 0 0.5 0 0.1 0\nSAVE-DATA\n"},
      {"speos",
       "OPTIS - brdf surface file v9.0\n0\nmatt\n0\n\n1\t1\n1\n2\t1\n0\t40\n550\n31\n2\t3\n\t0\t180\t360\n0\t0.1\t0.1\t0.1\n"
       "90\t0.1\t0.1\t0.1\n31\n2\t3\n\t0\t180\t360\n0\t0.1\t0.1\t0.1\n90\t0.1\t0.1\t0.1\n31\n2\t3\n\t0\t180\t360\n"
       "90\t0.1\t0.1\t0.1\n180\t0.1\t0.1\t0.1\n31\n2\t3\n\t0\t180\t360\n90\t0.1\t0.1\t0.1\n180\t0.1\t0.1\t0.1\n"},
      {"speos",
       "OPTIS - Anisotropic BSDF surface file v8.0\n0\ncomment\n0\n\n1 0 0\n1\t0\n1\n1\n0\n2\n0 30\n0 0\nspectrum\n1\n550 50\n"
       "2\t3\n\t0\t180\t360\n0\t0.1\t0.1\t0.1\n90\t0\t0\t0\n2\t3\n\t0\t180\t360\n0\t0.1\t0.1\t0.1\n90\t0\t0\t0\n"},
  };
  return files;
}

/// Formats of many nodes take what is quick to evaluate: their files say no more with another source.
bool suits(const Format& format, const char* source) {
  const std::string_view name = format.name, from = source;
  for (const char* large : {"radiance-", "merl", "utia", "exr-", "mbsdf", "ssdd", "rgl", "lighttools", "zemax", "speos", "tracepro"})
    if (name.starts_with(large))
      return from.ends_with("white") || from == "rgb-model" || (name.starts_with("rgl") && from.ends_with("rgl"));
  return true;
}

/// Moves a file to the folder of the reader that recognises it, if one does.
void hand_to_reader(const fs::path& file, const fs::path& corpus) {
  std::string head = gonio::read_file(file);
  const std::uintmax_t size = head.size();
  head.resize(std::min<std::size_t>(head.size(), 4096));
  for (const Format& format : formats())
    if (format.recognises && format.recognises(head, size)) {
      const bool cut = std::find(std::begin(of_one_size), std::end(of_one_size), std::string_view(format.name)) != std::end(of_one_size);
      if (size > largest_seed && !cut) break;
      if (size > largest_seed) fs::resize_file(file, largest_seed);
      const fs::path folder = corpus / format.name;
      fs::create_directories(folder);
      fs::rename(file, folder / file.filename());
      return;
    }
  fs::remove(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("fuzz_seeds DIR\n", stderr);
    return 2;
  }
  const fs::path corpus = argv[1];
  const std::vector<std::pair<const char*, Opened>> sources{
      {"samples", samples(single_channel("value"), false)},
      {"in-plane", samples(single_channel("value"), true)},
      {"rgb-samples", samples(rgb_channels(), false)},
      {"spectral-samples", samples(spectral(), false)},
      {"model", model(single_channel("value"))},
      {"rgb-model", model(rgb_channels())},
      {"spectral-model", model(spectral())},
      {"white", matt(single_channel("value"))},
      {"rgb-white", matt(rgb_channels())},
      {"rgl", small_rgl(rgb_channels())},
      {"spectral-rgl", small_rgl(spectral())},
  };
  WriteOptions options;
  options.size = GridSize::paper;
  const fs::path written = corpus / "written";
  for (const Format& format : formats()) {
    if (!format.write) continue;
    for (const auto& [name, source] : sources) {
      if (!suits(format, name)) continue;
      fs::create_directories(written);
      try {
        for (const fs::path& file :
             format.write(source, written / (std::string(format.name) + "-" + name + format.extension), options).files)
          if (fs::exists(file)) hand_to_reader(file, corpus);
      } catch (const Error&) {
        // Not every format takes every source.
      }
      fs::remove_all(written);
    }
  }
  for (std::size_t k = 0; k < by_hand().size(); ++k) {
    const auto& [format, text] = by_hand()[k];
    fs::create_directories(corpus / format);
    write_file_atomically(corpus / format / fmt::format("by-hand-{}", k), text);
  }
  fs::create_directories(corpus / "fit-json");
  for (const auto& example : fs::directory_iterator(GONIO_SOURCE_DIR "/data-schemas/examples/valid"))
    if (example.path().string().ends_with(".fit.json"))
      fs::copy_file(example, corpus / "fit-json" / example.path().filename(), fs::copy_options::overwrite_existing);
  return 0;
}
