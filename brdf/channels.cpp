// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/channels.hpp"

#include <array>
#include <utility>

namespace gonio {
namespace {

constexpr std::array<std::pair<Quantity, const char*>, 4> quantity_names{{
    {Quantity::f, "f"},
    {Quantity::f_cos, "f_cos"},
    {Quantity::reflectance_factor, "reflectance_factor"},
    {Quantity::signal_ratio, "signal_ratio"},
}};

}  // namespace

const char* name(Quantity quantity) noexcept {
  for (const auto& [value, text] : quantity_names)
    if (value == quantity) return text;
  return "f";
}

std::optional<Quantity> quantity_named(const std::string& text) {
  for (const auto& [value, label] : quantity_names)
    if (text == label) return value;
  return std::nullopt;
}

Channels single_channel(std::string name) {
  Channel channel;
  channel.name = std::move(name);
  return {std::move(channel)};
}

Channels rgb_channels() {
  Channels channels;
  for (const char* name : {"r", "g", "b"}) channels.push_back(single_channel(name).front());
  return channels;
}

}  // namespace gonio
