// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/channel_map.hpp"

#include <cmath>

#include "tests/tabulated/faults_text.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

Channels at(const std::vector<double>& wavelengths_nm) {
  Channels out;
  for (const double nm : wavelengths_nm) {
    out.push_back(single_channel(fmt::format("{}nm", nm)).front());
    out.back().wavelength_in_nm = out.back().wavelength_out_nm = nm;
  }
  return out;
}

std::vector<double> mapped(const ChannelMap& map, const std::vector<double>& in) {
  std::vector<double> out(map.to.size());
  map.apply(in.data(), out.data());
  return out;
}

}  // namespace

TEST_CASE("Channels that fit are passed on unchanged, and nothing is said") {
  const ChannelMap rgb = map_to_rgb(rgb_channels());
  CHECK(rgb.changed.empty());
  CHECK(mapped(rgb, {1, 2, -3}) == std::vector<double>{1, 2, -3});
  const ChannelMap spectrum = map_to_spectrum(at({600, 400, 500}));
  CHECK(spectrum.changed.empty());
  CHECK(spectrum.to == at({400, 500, 600}));
  CHECK(mapped(spectrum, {3, 1, 2}) == std::vector<double>{1, 2, 3});
}

TEST_CASE("One channel is copied: to red, green and blue, or as a constant spectrum") {
  CHECK(mapped(map_to_rgb(single_channel("value")), {0.25}) == std::vector<double>{0.25, 0.25, 0.25});
  CHECK(map_to_rgb(single_channel("value")).changed.find("value") != std::string::npos);
  const ChannelMap spectrum = map_to_spectrum(single_channel("value"));
  CHECK(spectrum.to == at({360, 830}));
  CHECK(mapped(spectrum, {0.25}) == std::vector<double>{0.25, 0.25});
}

TEST_CASE("Colours made into spectra are the same colours again") {
  const ChannelMap there = map_to_spectrum(rgb_channels()), back = map_to_rgb(there.to);
  for (const std::vector<double>& rgb : {std::vector<double>{1, 1, 1}, {0.2, 0.5, 0.1}, {30, 0, 2}, {-0.1, 0.4, 0.9}}) {
    const std::vector<double> seen = mapped(back, mapped(there, rgb));
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::fabs(seen[c] - rgb[c]) < 1e-4);
  }
  CHECK_FALSE(there.changed.empty());
  CHECK_FALSE(back.changed.empty());
}

TEST_CASE("The luminance of white is 1, that of green is above that of red") {
  CHECK(std::fabs(mapped(map_to_luminance(rgb_channels()), {1, 1, 1})[0] - 1) < 1e-12);
  CHECK(std::fabs(mapped(map_to_luminance(at({450, 550, 650})), {1, 1, 1})[0] - 1) < 1e-12);
  CHECK(mapped(map_to_luminance(single_channel("x")), {0.5})[0] == Approx(0.5));
  CHECK(mapped(map_to_luminance(rgb_channels()), {0, 1, 0})[0] > mapped(map_to_luminance(rgb_channels()), {1, 0, 0})[0]);
  const ChannelMap xyz = map_to_rgb([] {
    Channels out = rgb_channels();
    out[0].name = "X", out[1].name = "Y", out[2].name = "Z";
    return out;
  }());
  const auto white = mapped(xyz, {0.9505, 1, 1.0888});
  for (const double value : white) CHECK(std::fabs(value - 1) < 1e-3);
}

TEST_CASE("Channels of unknown meaning, fluorescence and a wavelength twice are refused") {
  Channels unknown = rgb_channels();
  unknown[1].name = "p";
  CHECK(test::faults_of([&] { map_to_rgb(unknown); }).find("r, p, b") != std::string::npos);
  CHECK(test::faults_of([&] { map_to_spectrum(unknown); }).find("r, p, b") != std::string::npos);
  CHECK(test::faults_of([&] { map_to_spectrum(at({500, 400, 500})); }).find("once") != std::string::npos);
  Channels fluorescent = at({400, 500});
  fluorescent[1].wavelength_in_nm = 380;
  CHECK(test::faults_of([&] { map_to_rgb(fluorescent); }).find("fluorescence") != std::string::npos);
}
