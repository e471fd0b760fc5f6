// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/brdf_exr_channels.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace gonio::tabulated {
namespace {

std::optional<double> wavelength_nm(const Channel& channel) {
  if (channel.wavelength_out_nm) return channel.wavelength_out_nm;
  if (channel.wavelength_in_nm) return channel.wavelength_in_nm;
  double value = 0;
  const char* const end = channel.name.data() + channel.name.size();
  const auto [after, error] = std::from_chars(channel.name.data(), end, value);
  if (error == std::errc() && std::string_view(after, static_cast<std::size_t>(end - after)) == "nm") return value;
  return std::nullopt;
}

}  // namespace

std::vector<std::string> exr_channel_names(const Channels& channels) {
  if (channels.size() == 1) return {"Y"};
  if (channels.size() == 3 && channels[0].name == "r" && channels[1].name == "g" && channels[2].name == "b") return {"R", "G", "B"};
  std::vector<std::string> out;
  for (const Channel& channel : channels) out.push_back("f." + channel.name);
  return out;
}

std::size_t exr_shown_channel(const Channels& channels) {
  constexpr double most_visible_nm = 555;
  std::size_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (const auto wavelength = wavelength_nm(channels[c]); wavelength && std::fabs(*wavelength - most_visible_nm) < nearest) {
      nearest = std::fabs(*wavelength - most_visible_nm);
      best = c;
    }
  return best;
}

}  // namespace gonio::tabulated
