// SPDX-License-Identifier: BSD-3-Clause
// `fuzz_seeds DIR` writes a seed corpus: DIR/FORMAT/SOURCE for every writer and a few small sources; `fuzz_reader` starts from them.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "brdf/analytic_brdf.hpp"
#include "brdf/error.hpp"
#include "tabulated/open.hpp"
#include "tabulated/opened_samples.hpp"

namespace fs = std::filesystem;
using namespace gonio;
using namespace gonio::tabulated;

namespace {

/// A seed larger than this only slows the fuzzer down; its start still shows the reader's way in.
constexpr std::uintmax_t largest_seed = 1 << 16;

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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("fuzz_seeds DIR\n", stderr);
    return 2;
  }
  const std::vector<std::pair<const char*, Opened>> sources{
      {"samples", samples(single_channel("value"), false)},
      {"in-plane", samples(single_channel("value"), true)},
      {"rgb-samples", samples(rgb_channels(), false)},
      {"spectral-samples", samples(spectral(), false)},
      {"model", model(single_channel("value"))},
      {"rgb-model", model(rgb_channels())},
      {"spectral-model", model(spectral())},
  };
  WriteOptions options;
  options.size = GridSize::paper;
  for (const Format& format : formats()) {
    const fs::path folder = fs::path(argv[1]) / format.name;
    fs::create_directories(folder);
    if (!format.write) continue;
    for (const auto& [name, source] : sources) {
      const fs::path file = folder / (std::string(name) + format.extension);
      try {
        for (const fs::path& written : format.write(source, file, options).files)
          if (fs::file_size(written) > largest_seed) fs::resize_file(written, largest_seed);
      } catch (const Error&) {
        // Not every format takes every source.
      }
    }
  }
  for (const auto& example : fs::directory_iterator(GONIO_SOURCE_DIR "/data-schemas/examples/valid"))
    if (example.path().string().ends_with(".fit.json"))
      fs::copy_file(example, fs::path(argv[1]) / "fit-json" / example.path().filename(), fs::copy_options::overwrite_existing);
  return 0;
}
