// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/row_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace gonio::tabulated {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The samples at one direction, and how many of them each channel has filled.
struct Place {
  std::vector<std::size_t> samples, filled;
};

}  // namespace

RowSamples samples_of_rows(const std::vector<ValueRow>& rows, Channels channels) {
  RowSamples out;
  Dataset& data = out.samples;
  data.channels = std::move(channels);
  const std::size_t channel_count = data.channels.size();
  data.f.resize(channel_count), data.u.resize(channel_count);
  std::map<std::array<double, 4>, Place> places;
  bool known = false;
  for (const ValueRow& row : rows) {
    const GonioAngles& at = row.angles;
    Place& place = places[{at.theta_i.degrees(), at.phi_i.degrees(), at.theta_o.degrees(), at.phi_o.degrees()}];
    place.filled.resize(channel_count);
    const std::size_t repeat = place.filled[row.channel]++;
    if (repeat == place.samples.size()) {
      place.samples.push_back(data.size());
      data.angles.push_back(at);
      for (std::size_t c = 0; c < channel_count; ++c) data.f[c].push_back(unknown), data.u[c].push_back(unknown);
    }
    const std::size_t sample = place.samples[repeat];
    data.f[row.channel][sample] = row.f;
    data.u[row.channel][sample] = row.u;
    known = known || !std::isnan(row.u);
    out.sample_of.push_back(sample);
  }
  if (!known) data.u.clear();
  return out;
}

}  // namespace gonio::tabulated
