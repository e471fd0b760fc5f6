// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/difference_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "fitting/compare.hpp"

namespace gonio::fitting {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t most_discs = 6;

/// Values of A and B, one per channel, at a pixel.
struct PixelValues {
  std::vector<double> a, b;
};

void set_pixel(DifferenceImage& image, std::size_t at, const PixelValues& values) {
  double a = 0, b = 0;
  for (std::size_t c = 0; c < image.differences.size(); ++c) {
    if (std::isfinite(values.a[c]) && std::isfinite(values.b[c]))
      image.differences[c][at] = static_cast<float>(relative_difference(values.a[c], values.b[c]));
    a += values.a[c];
    b += values.b[c];
  }
  if (std::isfinite(a) && std::isfinite(b)) image.mean[at] = static_cast<float>(relative_difference(a, b));
}

template <class ValuesAt>
void fill_disc(DifferenceImage& image, std::size_t disc, ValuesAt&& values_at) {
  for (std::size_t row = 0; row < image.size; ++row)
    for (std::size_t column = 0; column < image.size; ++column)
      if (const auto direction = disc_direction(row, column, image.size))
        if (const auto values = values_at(*direction)) set_pixel(image, row * image.width() + disc * image.size + column, *values);
}

void resize(DifferenceImage& image, std::size_t channels) {
  image.mean.assign(image.size * image.width(), unknown);
  image.differences.assign(channels, image.mean);
}

void fill_by_evaluation(DifferenceImage& image, const CompareSubject& a, const CompareSubject& b, const ComparedValues& values) {
  double highest = 0;
  for (const GonioAngles& angles : values.angles) highest = std::max(highest, angles.theta_i.degrees());
  for (const double theta_i_deg : {5.0, 30.0, 45.0, 60.0, 75.0})
    if (theta_i_deg <= highest) image.discs.push_back({theta_i_deg, 0});
  resize(image, values.channels.size());
  for (std::size_t disc = 0; disc < image.discs.size(); ++disc) {
    const Direction wi = Direction::spherical(degrees(image.discs[disc].theta_i_deg), degrees(0));
    fill_disc(image, disc, [&](const DiscDirection& direction) -> std::optional<PixelValues> {
      const Direction wo = Direction::spherical(direction.theta_o, direction.turn);
      const auto f_a = a.brdf->eval(wi, wo), f_b = b.brdf->eval(wi, wo);
      PixelValues out;
      for (const ComparedChannel& channel : values.channels) out.a.push_back(f_a[channel.a]), out.b.push_back(f_b[channel.b]);
      return out;
    });
  }
}

/// The samples of one incidence and the directions in which they went, with the light turned to azimuth 0.
struct Incidence {
  DifferenceImage::Disc disc;
  std::vector<std::size_t> samples;
  std::vector<Direction> outgoing;
};

std::vector<Incidence> most_sampled_incidences(const ComparedValues& values) {
  constexpr double same_deg = 0.1;
  std::map<std::pair<long, long>, Incidence> groups;
  for (std::size_t k = 0; k < values.angles.size(); ++k) {
    const GonioAngles& angles = values.angles[k];
    const double phi_i = values.isotropic || angles.theta_i.degrees() < same_deg ? 0 : angles.phi_i.degrees();
    Incidence& group = groups[{std::lround(angles.theta_i.degrees() / same_deg), std::lround(phi_i / same_deg)}];
    group.disc = {angles.theta_i.degrees(), phi_i};
    group.samples.push_back(k);
    group.outgoing.push_back(Direction::spherical(angles.theta_o, angles.phi_o - angles.phi_i));
  }
  std::vector<Incidence> out;
  for (auto& [key, group] : groups) out.push_back(std::move(group));
  std::stable_sort(out.begin(), out.end(), [](const Incidence& x, const Incidence& y) { return x.samples.size() > y.samples.size(); });
  out.resize(std::min(out.size(), most_discs));
  std::sort(out.begin(), out.end(), [](const Incidence& x, const Incidence& y) {
    return std::pair(x.disc.theta_i_deg, x.disc.phi_i_deg) < std::pair(y.disc.theta_i_deg, y.disc.phi_i_deg);
  });
  return out;
}

void fill_from_samples(DifferenceImage& image, const ComparedValues& values) {
  constexpr double reach = 7.5 * std::numbers::pi / 180;
  const std::vector<Incidence> incidences = most_sampled_incidences(values);
  for (const Incidence& incidence : incidences) image.discs.push_back(incidence.disc);
  resize(image, values.channels.size());
  for (std::size_t disc = 0; disc < incidences.size(); ++disc) {
    const Incidence& incidence = incidences[disc];
    fill_disc(image, disc, [&](const DiscDirection& direction) -> std::optional<PixelValues> {
      const Direction wo = Direction::spherical(direction.theta_o, direction.turn);
      double nearest = std::cos(reach);
      std::optional<std::size_t> found;
      for (std::size_t k = 0; k < incidence.samples.size(); ++k)
        if (const double cosine = dot(wo, incidence.outgoing[k]); cosine >= nearest) nearest = cosine, found = incidence.samples[k];
      if (!found) return std::nullopt;
      PixelValues out;
      for (std::size_t c = 0; c < values.channels.size(); ++c)
        out.a.push_back(values.a.f[c][*found]), out.b.push_back(values.b.f[c][*found]);
      return out;
    });
  }
}

}  // namespace

std::optional<DiscDirection> disc_direction(std::size_t row, std::size_t column, std::size_t size) noexcept {
  const double half = 0.5 * static_cast<double>(size);
  const double x = (static_cast<double>(column) + 0.5 - half) / half, y = (static_cast<double>(row) + 0.5 - half) / half;
  const double radius = std::hypot(x, y);
  if (!(radius < 1)) return std::nullopt;
  return DiscDirection{degrees(90 * radius), radius > 0 ? radians(std::atan2(y, -x)) : degrees(0)};
}

DifferenceImage difference_image(const CompareSubject& a, const CompareSubject& b, const ComparedValues& values, std::size_t size) {
  DifferenceImage out;
  out.size = size;
  if (values.at == ComparedAt::quadrature)
    fill_by_evaluation(out, a, b, values);
  else
    fill_from_samples(out, values);
  return out;
}

}  // namespace gonio::fitting
