// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/klems_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gonio::tabulated {

KlemsTable::KlemsTable(KlemsBasis incident, KlemsBasis outgoing, SheetSide side, Channels channels, std::vector<std::vector<double>> values)
    : incident_(std::move(incident)),
      outgoing_(std::move(outgoing)),
      side_(side),
      channels_(std::move(channels)),
      values_(std::move(values)) {}

void KlemsTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  const std::size_t channel_count = channels_.size();
  const double sign = side_.y_sign();
  for (std::size_t k = 0; k < wi.size(); ++k) {
    double* const out = f.data() + k * channel_count;
    if (!side_.holds(wi[k], wo[k])) {
      std::fill_n(out, channel_count, 0.0);
      continue;
    }
    const auto from = incident_.patch_of(-wi[k].x(), -sign * wi[k].y(), wi[k].z());
    const auto to = outgoing_.patch_of(wo[k].x(), sign * wo[k].y(), std::fabs(wo[k].z()));
    for (std::size_t c = 0; c < channel_count; ++c) out[c] = from && to ? value(c, *from, *to) : std::numeric_limits<double>::quiet_NaN();
  }
}

Dataset KlemsTable::samples() const {
  Dataset out;
  out.channels = channels_;
  out.side = side_.kind;
  out.f.resize(channels_.size());
  const double sign = side_.y_sign();
  for (std::size_t in = 0; in < incident_.size(); ++in)
    for (std::size_t to = 0; to < outgoing_.size(); ++to) {
      if (std::isnan(value(0, in, to))) continue;
      const double theta_o = outgoing_.centre_theta(to).degrees();
      out.angles.push_back({incident_.centre_theta(in), degrees(sign * (incident_.centre_phi(in).degrees() - 180)),
                            degrees(side_.kind == Side::reflection ? theta_o : 180 - theta_o),
                            degrees(sign * outgoing_.centre_phi(to).degrees())});
      for (std::size_t c = 0; c < channels_.size(); ++c) out.f[c].push_back(value(c, in, to));
    }
  return out;
}

double KlemsTable::hemispherical(std::size_t channel, std::size_t in) const {
  double sum = 0;
  for (std::size_t to = 0; to < outgoing_.size(); ++to)
    if (const double f = value(channel, in, to); !std::isnan(f)) sum += f * outgoing_.projected_solid_angle(to);
  return sum;
}

}  // namespace gonio::tabulated
