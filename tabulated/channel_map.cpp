// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/channel_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "brdf/error.hpp"
#include "tabulated/colour_matching.hpp"
#include "tabulated/describe.hpp"
#include "tabulated/rgb_to_spectrum.hpp"

namespace gonio::tabulated {
namespace {

bool are_named(const Channels& channels, const std::array<const char*, 3>& names) {
  return std::equal(channels.begin(), channels.end(), names.begin(), names.end(),
                    [](const Channel& channel, const char* name) { return channel.name == name; });
}

bool are_spectral(const Channels& channels) {
  return !channels.empty() &&
         std::all_of(channels.begin(), channels.end(), [](const Channel& c) { return c.wavelength_out_nm.has_value(); });
}

[[noreturn]] void refuse(const Channels& channels, const char* wanted) {
  throw Error(ErrorKind::input, {"the channels of the source", joined_names(channels), wanted});
}

/// The places of the channels in the order of their wavelengths.
std::vector<std::size_t> by_wavelength(const Channels& channels) {
  std::vector<std::size_t> order(channels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return *channels[a].wavelength_out_nm < *channels[b].wavelength_out_nm; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Channel& channel = channels[order[k]];
    if (channel.wavelength_in_nm && *channel.wavelength_in_nm != *channel.wavelength_out_nm)
      refuse(channels, "no fluorescence: light that leaves at the wavelength at which it came");
    if (k > 0 && *channel.wavelength_out_nm == *channels[order[k - 1]].wavelength_out_nm) refuse(channels, "every wavelength once");
  }
  return order;
}

Channel at_wavelength(double nm) {
  Channel out;
  out.name = fmt::format("{}nm", nm);
  out.wavelength_in_nm = out.wavelength_out_nm = nm;
  return out;
}

ChannelMap unchanged(const Channels& channels, const std::vector<std::size_t>& order) {
  ChannelMap out;
  out.weights.assign(channels.size() * channels.size(), 0.0);
  for (std::size_t k = 0; k < order.size(); ++k) {
    out.to.push_back(channels[order[k]]);
    out.weights[k * channels.size() + order[k]] = 1;
  }
  return out;
}

ChannelMap spectrum_to_rgb(const Channels& from) {
  const std::vector<std::size_t> order = by_wavelength(from);
  std::vector<double> wavelengths;
  for (const std::size_t k : order) wavelengths.push_back(*from[k].wavelength_out_nm);
  const auto weights = rgb_weights(wavelengths);
  ChannelMap out{.to = rgb_channels(), .weights = std::vector<double>(3 * from.size()), .changed = {}};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < order.size(); ++k) out.weights[c * from.size() + order[k]] = weights[c][k];
  out.changed = fmt::format(
      "{} wavelengths from {:g} to {:g} nm are written as linear sRGB, as seen under D65 by the CIE 1931 observer; beyond them the first "
      "and "
      "the last value hold",
      from.size(), wavelengths.front(), wavelengths.back());
  return out;
}

}  // namespace

void ChannelMap::apply(const double* in, double* out) const {
  const std::size_t from_count = weights.size() / to.size();
  for (std::size_t k = 0; k < to.size(); ++k) out[k] = std::inner_product(in, in + from_count, weights.data() + k * from_count, 0.0);
}

ChannelMap map_to_rgb(const Channels& from) {
  if (from.size() == 1)
    return {.to = rgb_channels(),
            .weights = {1, 1, 1},
            .changed = fmt::format("the one channel, {}, is copied to red, green and blue", from.front().name)};
  if (are_named(from, {"r", "g", "b"})) return unchanged(from, {0, 1, 2});
  if (are_named(from, {"X", "Y", "Z"})) {
    ChannelMap out{.to = rgb_channels(), .weights = {}, .changed = "X, Y, Z are written as linear sRGB, the white being D65"};
    for (const auto& row : rgb_from_xyz()) out.weights.insert(out.weights.end(), row.begin(), row.end());
    return out;
  }
  if (are_spectral(from)) return spectrum_to_rgb(from);
  refuse(from, "one channel, or r, g, b, or X, Y, Z, or channels with wavelengths");
}

ChannelMap map_to_spectrum(const Channels& from) {
  if (from.size() == 1) {
    const double last_nm = PrimarySpectra::first_nm + PrimarySpectra::step_nm * (PrimarySpectra::count - 1);
    return {.to = {at_wavelength(PrimarySpectra::first_nm), at_wavelength(last_nm)},
            .weights = {1, 1},
            .changed = fmt::format("the one channel, {}, is written as a spectrum that is constant", from.front().name)};
  }
  if (are_spectral(from)) return unchanged(from, by_wavelength(from));
  if (!are_named(from, {"r", "g", "b"})) refuse(from, "one channel, or r, g, b, or channels with wavelengths");
  ChannelMap out;
  const auto& primaries = PrimarySpectra::values();
  for (std::size_t k = 0; k < PrimarySpectra::count; ++k) {
    out.to.push_back(at_wavelength(PrimarySpectra::first_nm + PrimarySpectra::step_nm * static_cast<double>(k)));
    for (std::size_t c = 0; c < 3; ++c) out.weights.push_back(primaries[c][k]);
  }
  out.changed =
      "the spectra are made up: the smoothest ones that give back red, green and blue (taken as linear sRGB) under D65, 360 to 830 nm "
      "every "
      "10 nm";
  return out;
}

ChannelMap map_to_xyz(const Channels& from) {
  if (are_named(from, {"X", "Y", "Z"})) return unchanged(from, {0, 1, 2});
  const ChannelMap rgb = map_to_rgb(from);
  // The inverse of the matrix by its cofactors.
  const auto& m = rgb_from_xyz();
  const auto cofactor = [&](std::size_t row, std::size_t column) {
    const std::size_t r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  ChannelMap out{.to = Channels(3), .weights = std::vector<double>(3 * from.size()), .changed = rgb.changed};
  for (std::size_t xyz = 0; xyz < 3; ++xyz) {
    out.to[xyz].name = std::string(1, "XYZ"[xyz]);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < from.size(); ++k)
        out.weights[xyz * from.size() + k] += cofactor(c, xyz) / determinant * rgb.weights[c * from.size() + k];
  }
  out.changed += (rgb.changed.empty() ? "" : "; ") + std::string("red, green, blue, taken as linear sRGB, are written as X, Y, Z");
  return out;
}

ChannelMap map_to_luminance(const Channels& from) {
  const ChannelMap rgb = map_to_rgb(from);
  Channels y = single_channel("Y");
  ChannelMap out{.to = std::move(y), .weights = std::vector<double>(from.size()), .changed = {}};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < from.size(); ++k) out.weights[k] += luminance_of_rgb[c] * rgb.weights[c * from.size() + k];
  return out;
}

}  // namespace gonio::tabulated
