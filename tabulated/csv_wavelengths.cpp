// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/csv_wavelengths.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>
#include <utility>

namespace gonio::tabulated {
namespace {

using Pose = std::array<double, 4>;

Pose pose_of(const GonioAngles& angles) {
  return {angles.theta_i.radians(), angles.phi_i.radians(), angles.theta_o.radians(), angles.phi_o.radians()};
}

Channel channel_at(double wavelength_nm) {
  Channel out;
  out.name = fmt::format("{}nm", wavelength_nm);
  out.wavelength_in_nm = out.wavelength_out_nm = wavelength_nm;
  return out;
}

}  // namespace

Dataset channels_by_wavelength(Dataset flat, const std::vector<double>& wavelength_nm, FaultList& faults) {
  if (flat.channels.size() != 1)
    faults.add(faults.file(), fmt::format("a column of wavelengths and {} channels", flat.channels.size()),
               "one channel, given with --columns value=NAME");
  if (!flat.extra.empty() || !flat.correlated.empty())
    faults.add(faults.file(), "a column of wavelengths and optional columns", "one of the two");
  if (!faults.empty()) return flat;

  std::map<double, std::size_t> channel_of;
  for (const double wavelength : wavelength_nm) channel_of.emplace(wavelength, 0);
  Dataset out = flat;
  out.channels.clear();
  out.angles.clear();
  for (auto& [wavelength, channel] : channel_of) {
    channel = out.channels.size();
    out.channels.push_back(channel_at(wavelength));
  }
  out.f.assign(out.channels.size(), {});
  if (flat.has_uncertainty()) out.u.assign(out.channels.size(), {});

  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::map<Pose, std::vector<std::size_t>> samples_at;          // in order of repetition
  std::map<std::pair<Pose, std::size_t>, std::size_t> repeats;  // of a pose in a channel
  for (std::size_t k = 0; k < flat.size(); ++k) {
    const Pose pose = pose_of(flat.angles[k]);
    const std::size_t channel = channel_of[wavelength_nm[k]], repeat = repeats[{pose, channel}]++;
    std::vector<std::size_t>& samples = samples_at[pose];
    if (repeat == samples.size()) {
      samples.push_back(out.angles.size());
      out.angles.push_back(flat.angles[k]);
      for (auto* columns : {&out.f, &out.u})
        for (auto& column : *columns) column.push_back(unknown);
    }
    out.f[channel][samples[repeat]] = flat.f[0][k];
    if (flat.has_uncertainty()) out.u[channel][samples[repeat]] = flat.u[0][k];
  }
  return out;
}

}  // namespace gonio::tabulated
