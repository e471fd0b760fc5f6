// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv_wavelengths.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "tabulated/row_samples.hpp"

namespace gonio::tabulated {
namespace {

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
  Channels channels;
  for (auto& [wavelength, channel] : channel_of) {
    channel = channels.size();
    channels.push_back(channel_at(wavelength));
  }
  std::vector<ValueRow> rows;
  for (std::size_t k = 0; k < flat.size(); ++k) {
    rows.push_back({flat.angles[k], channel_of[wavelength_nm[k]], flat.f[0][k]});
    if (flat.has_uncertainty()) rows.back().u = flat.u[0][k];
  }
  Dataset samples = samples_of_rows(rows, std::move(channels)).samples;
  Dataset out = std::move(flat);
  out.channels = std::move(samples.channels);
  out.angles = std::move(samples.angles);
  out.f = std::move(samples.f);
  out.u = std::move(samples.u);
  return out;
}

}  // namespace gonio::tabulated
