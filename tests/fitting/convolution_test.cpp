// SPDX-License-Identifier: BSD-3-Clause
// Means over apertures in the rows of a fit: right where they count, left out where they do not.
#include "fitting/convolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "brdf/lobe_kernels.hpp"
#include "fitting/terms.hpp"
#include "tests/fitting/cone_mean.hpp"
#include "tests/fitting/synthetic.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;
using namespace gonio::test;

namespace {

constexpr double degree = std::numbers::pi / 180;
const std::vector<std::vector<double>> linear{{.2, .3}};

/// Across the mirror direction, in the plane of incidence and beside it.
std::vector<GonioAngles> across_the_peak(const std::vector<double>& theta_i_deg) {
  std::vector<GonioAngles> out;
  for (const double theta_i : theta_i_deg)
    for (const double step : {-4., -1.5, -.7, -.3, 0., .2, .5, 1., 2.5, 8.})
      for (const double turn : {0., .4}) out.push_back({degrees(theta_i), degrees(10), degrees(theta_i + step), degrees(190 + turn)});
  return out;
}

/// Rows of a fit to a half-vector lobe over a diffuse part, with the means they call for at readings of 1 % + 1e-4 1/sr.
struct Convolved {
  Convolved(const std::vector<GonioAngles>& angles, double exponent, double source_deg, double receiver_deg, int rings) : s(exponent) {
    const AnalyticBrdf truth("blinn-phong-ngan", single_channel("Y"), {{linear[0][0], linear[0][1], s}});
    const auto data = readings(truth, angles, {}, 1);
    if (source_deg > 0) data->apertures.source_half_angle_deg = source_deg;
    if (receiver_deg > 0) data->apertures.receiver_half_angle_deg = receiver_deg;
    const double peak = (s + 2) / (2 * std::numbers::pi);
    for (const GonioAngles& a : angles) {
      const double lobe = cone_mean(a, source_deg * degree, receiver_deg * degree, rings, [&](const Direction& wi, const Direction& wo) {
        return peak * cosine_power(lobe_geometry(wi, wo).log_cos_h, s);
      });
      by_force.push_back(linear[0][0] / std::numbers::pi + linear[0][1] * lobe);
      sigma.push_back(std::hypot(.01 * by_force.back(), 1e-4));
      weight[0].push_back(1 / (sigma.back() * sigma.back()));
    }
    point = data->f[0];
    const auto observations = observe(data);
    terms = make_terms(*observations, model_kernel("blinn-phong-ngan"), Metric::linear, 1);
    effect = convolve(terms, *observations, linear, {s}, weight, 1);
    std::vector<double> columns(2 * terms.rows());
    terms.basis(0, terms.rows(), &s, columns.data(), terms.rows());
    for (std::size_t row = 0; row < terms.rows(); ++row)
      fitted.push_back(linear[0][0] * columns[row] + linear[0][1] * columns[terms.rows() + row]);
  }
  /// √Σ z² of values against the means by brute force: no parameter is moved by more than this many of its standard uncertainties.
  double distance(const std::vector<double>& values) const {
    double sum = 0;
    for (std::size_t row = 0; row < values.size(); ++row) sum += std::pow((values[row] - by_force[row]) / sigma[row], 2);
    return std::sqrt(sum);
  }

  double s;
  Terms terms;
  ApertureEffect effect;
  std::vector<double> by_force, sigma, point, fitted;  ///< of every row [1/sr]; `fitted` as the fit sees it
  std::vector<std::vector<double>> weight{1};
};

// Standard uncertainties of a parameter: where the whole effect is below this nothing is done, and what is done is better than this.
constexpr double promised = .1;

}  // namespace

TEST_CASE("rows are the means over an aperture that brute force gives, for exponents up to 1e5 and incidences up to 80°") {
  const std::vector<GonioAngles> angles = across_the_peak({5, 40, 80});
  std::string figures;
  for (const double half_angle : {.25, .5, 1.})
    for (const double s : {100., 1e3, 1e4, 1e5})
      for (const bool of_source : {false, true}) {
        const Convolved rows(angles, s, of_source ? half_angle : 0, of_source ? 0 : half_angle, 150);
        const double off = rows.distance(rows.fitted), points_off = rows.distance(rows.point);
        const auto text = fmt::format("s {:g}, half-angle {} degrees of the {}: {:.2g} sigma from the truth, points {:.2g}", s, half_angle,
                                      of_source ? "source" : "receiver", off, points_off);
        if (!of_source) figures += "\n  " + text;
        INFO(text << "; " << rows.effect.reason);
        CHECK(off < promised);
        // The gate itself, and the bound that is reported: points are off by as much as it says.
        CHECK(points_off > 10 * promised);
        CHECK(rows.effect.on);
        CHECK(rows.effect.bound == Approx(points_off).epsilon(.01));
        CHECK(rows.effect.n_samples == rows.terms.mean.row.size());
        CHECK(rows.effect.reason.find("finer") == std::string::npos);
      }
  WARN(figures);
}

TEST_CASE("apertures of source and receiver together are a mean over both") {
  for (const double s : {1e3, 1e4}) {
    const Convolved rows({{degrees(30), degrees(0), degrees(30), degrees(180)},
                          {degrees(30), degrees(0), degrees(31), degrees(180)},
                          {degrees(70), degrees(0), degrees(70.5), degrees(180.5)}},
                         s, .5, .3, 16);
    INFO("s " << s << ": " << rows.distance(rows.fitted) << " of " << rows.distance(rows.point) << "; " << rows.effect.reason);
    CHECK(rows.distance(rows.fitted) < promised);
    CHECK(rows.distance(rows.point) > 10 * promised);
  }
}

TEST_CASE("an aperture across the horizon is a mean over what is above it") {
  for (const double s : {1., 100., 1e3}) {
    const Convolved rows({{degrees(80), degrees(0), degrees(89), degrees(180)},
                          {degrees(80), degrees(0), degrees(89.7), degrees(180)},
                          {degrees(80), degrees(0), degrees(90), degrees(180)}},
                         s, 0, .5, 300);
    INFO("s " << s << ": " << rows.distance(rows.fitted) << " of " << rows.distance(rows.point) << "; " << rows.effect.reason);
    CHECK(rows.terms.rows() == 3);
    CHECK(rows.distance(rows.fitted) < promised);
    // Rules converge slowly on a disc that is cut in the midst of a lobe: with both directions at the horizon they are good for 1 %.
    const Convolved grazing({{degrees(89.9), degrees(0), degrees(89.9), degrees(180)}}, s, 0, .5, 300);
    CHECK(grazing.distance(grazing.fitted) < 1);
    if (s > 1) CHECK(grazing.distance(grazing.point) > 10);
  }
}

TEST_CASE("derivatives of means are those of their differences") {
  for (const double s : {50., 1e3, 1e5}) {
    const Convolved rows(across_the_peak({5, 75}), s, 0, .5, 1);
    const Terms& terms = rows.terms;
    const std::size_t n = terms.rows();
    REQUIRE(!terms.mean.empty());
    std::vector<double> columns(2 * n), slopes(2 * n), below(2 * n), above(2 * n), part(2 * n);
    terms.basis_and_slopes(0, n, &s, columns.data(), slopes.data(), n);
    const double step = 1e-5 * s, low = s - step, high = s + step;
    terms.basis(0, n, &low, below.data(), n);
    terms.basis(0, n, &high, above.data(), n);
    for (std::size_t k = 0; k < 2 * n; ++k) {
      INFO("s " << s << ", column " << k);
      CHECK(slopes[k] == Approx((above[k] - below[k]) / (2 * step)).epsilon(1e-6).margin(1e-9 / s));
    }
    // A part of the rows is the same part of the columns.
    const std::size_t begin = 7, end = n - 5;
    terms.basis(begin, end, &s, part.data(), n);
    for (std::size_t row = begin; row < end; ++row)
      for (std::size_t c = 0; c < 2; ++c) CHECK(part[c * n + row - begin] == columns[c * n + row]);
  }
}

TEST_CASE("means that would change nothing are left out, and the reason says so") {
  const Convolved broad(across_the_peak({5, 40}), 10, 0, .1, 1);
  CHECK(!broad.effect.on);
  CHECK(broad.terms.mean.empty());
  CHECK(broad.effect.bound < .1);
  CHECK(broad.effect.reason.find("left out") == 0);
  CHECK(broad.fitted == broad.point);
}

TEST_CASE("what rules cannot settle is said") {
  const Convolved rows(across_the_peak({80}), 1e6, 0, 2, 1);
  CHECK(rows.effect.reason.find("finer rules still could") != std::string::npos);
}

TEST_CASE("a part of the means keeps the nodes of its rows under their new numbers") {
  const Convolved rows(across_the_peak({40}), 1e4, 0, .5, 1);
  const MeanRows& all = rows.terms.mean;
  REQUIRE(all.row.size() > 4);
  // A row without a mean between two with one, in an order of their own.
  const std::vector<std::size_t> wanted{all.row[3], rows.terms.rows(), all.row[1]};
  const MeanRows some = all.of(wanted);
  CHECK(some.row == std::vector<std::size_t>{0, 2});
  for (std::size_t j = 0; j < 2; ++j) {
    const std::size_t from = j == 0 ? 3 : 1, size = all.first[from + 1] - all.first[from];
    REQUIRE(some.first[j + 1] - some.first[j] == size);
    for (std::size_t k = 0; k < size; ++k) {
      CHECK(some.weight[some.first[j] + k] == all.weight[all.first[from] + k]);
      CHECK(some.geometry[some.first[j] + k].log_cos_h == all.geometry[all.first[from] + k].log_cos_h);
    }
  }
  CHECK(MeanRows{}.of(wanted).empty());
}
