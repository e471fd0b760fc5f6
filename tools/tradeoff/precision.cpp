// SPDX-License-Identifier: BSD-3-Clause
// Topic precision: float against double and naive against stable kernels at the hard places, nanoseconds against error.
//
// The places C1 to C11, where the plain formula breaks: C1 the half-vector lobe near its peak, C1b the mirror lobe, C1c the same through
// the chord |n - h|, C2 the derivative of cos^s where the cosine is 0 or slightly negative, C3 mirrored pairs at grazing, C4 θh by acos,
// C4b θd by acos at retro-reflection, C5 the cosine near 90°, C6 the ratio of gamma functions, C7 the logarithm of a lobe that underflows,
// C8 a sum of many values, C9 a residual sum of squares, C10 a lobe that hardly differs from diffuse, C11 the product in the exact norm.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "brdf/beta_function.hpp"
#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/coordinates.hpp"
#include "brdf/lobe_kernels.hpp"
#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {
namespace {

/// The numbers one evaluation starts from; what they mean is each place's own.
template <class T>
using Inputs = std::array<T, 6>;

template <class To, class From>
Inputs<To> converted(const Inputs<From>& from) {
  Inputs<To> out;
  std::transform(from.begin(), from.end(), out.begin(), [](From value) { return static_cast<To>(value); });
  return out;
}

template <class T>
Vector3<T> wi(const Inputs<T>& in) {
  return {in[0], in[1], in[2]};
}
template <class T>
Vector3<T> wo(const Inputs<T>& in) {
  return {in[3], in[4], in[5]};
}

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
Vector3<T> normalised_half(const Inputs<T>& in) {
  const Vector3<T> h{in[0] + in[3], in[1] + in[4], in[2] + in[5]};
  const T length = std::sqrt(dot(h, h));
  return {h.x / length, h.y / length, h.z / length};
}

/// Collects the panels. `naive` and `stable` are callable as `f(Inputs<T>) -> T` for float, double and long double; the truth is `stable`
/// in long double on the very inputs a kernel was given, so that the rounding of the inputs counts for no kernel.
class Places {
 public:
  Places(const Effort& effort, Measured& out) : effort_(effort), out_(out) {}

  template <class Naive, class Stable>
  void add(std::string name, std::vector<Inputs<double>> inputs, Naive naive, Stable stable, std::size_t evaluations = 1) {
    evaluations_ = evaluations;
    begin(std::move(name), inputs);
    measure<float>("float, naive", "", inputs, naive, stable);
    measure<double>("double, naive", "", inputs, naive, stable);
    add_stable("", inputs, stable, stable);
  }

  /// Another stable form at the place added last.
  template <class Stable, class Truth>
  void add_stable(const std::string& setting, const std::vector<Inputs<double>>& inputs, Stable stable, Truth truth) {
    measure<float>("float, stable", setting, inputs, stable, truth);
    measure<double>("double, stable", setting, inputs, stable, truth);
  }

 private:
  void begin(std::string name, const std::vector<Inputs<double>>& inputs) {
    constexpr double places = 15;
    effort_.progress(static_cast<double>(out_.panels.size()) / places, name);
    const Timing reading = time_of(
        [&] {
          double sum = 0;
          for (const auto& in : inputs)
            for (const double value : in) sum += value;
          return sum;
        },
        inputs.size(), least_run());
    Panel panel;
    panel.name = std::move(name);
    panel.error_floors = {{std::numeric_limits<float>::epsilon() / 2, "rounding of a float, 6e-8"},
                          {std::numeric_limits<double>::epsilon() / 2, "rounding of a double, 1.1e-16"}};
    // One of the values for a kernel that makes many evaluations from one input.
    const double limit = evaluations_ > 1 ? reading.median_s / 6 : reading.median_s;
    panel.limit = {limit, fmt::format("reading the inputs, {:.1f} ns", limit * 1e9)};
    out_.panels.push_back(std::move(panel));
  }

  template <class T, class Kernel, class Truth>
  void measure(const std::string& method, const std::string& setting, const std::vector<Inputs<double>>& wanted, Kernel kernel,
               Truth truth) {
    std::vector<Inputs<T>> inputs;
    for (const auto& in : wanted) inputs.push_back(converted<T>(in));
    Point point;
    point.panel = out_.panels.back().name, point.method = method, point.setting = setting;
    double worst = -1;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      const long double exact = truth(converted<long double>(inputs[k])), found = kernel(inputs[k]);
      // Where the truth is 0 the error is taken as it is.
      const auto error = static_cast<double>(std::fabs(found - exact) / (exact == 0 ? 1 : std::fabs(exact)));
      if (!std::isfinite(error)) worst = error, point.worst_at = fmt::format("input {}", k + 1);
      if (!std::isfinite(worst)) break;
      if (error > worst) worst = error, point.worst_at = fmt::format("input {}", k + 1);
    }
    if (std::isfinite(worst)) point.error = worst;
    point.time = time_of(
        [&] {
          T sum = 0;
          for (const auto& in : inputs) sum += kernel(in);
          return static_cast<double>(sum);
        },
        inputs.size() * evaluations_, least_run());
    out_.points.push_back(std::move(point));
  }

  double least_run() const { return effort_.quick ? 1e-4 : 5e-3; }

  const Effort& effort_;
  Measured& out_;
  std::size_t evaluations_ = 1;  ///< that one call of a kernel makes
};

/// Pairs whose half vector stands at θh, about the normal or turned by φ, for several incidences.
std::vector<Inputs<double>> pairs_with_half_at(const std::vector<double>& thetas_h) {
  std::vector<Inputs<double>> out;
  for (const double theta_h : thetas_h)
    for (const double theta_d : {0.1, 0.7, 1.2}) {
      const DirectionPair pair = directions({radians(theta_h), radians(0.3), radians(theta_d), radians(1.1)});
      out.push_back({pair.wi.x(), pair.wi.y(), pair.wi.z(), pair.wo.x(), pair.wo.y(), pair.wo.z()});
    }
  return out;
}

std::vector<double> from_to(double low, double high, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(low + (high - low) * k / (count - 1));
  return out;
}

void add_lobes(Places& places) {
  for (const double s : {1e6, 1e9}) {
    // s θh²/2 from 0 to 8: from the peak to e^-8 of it.
    std::vector<double> thetas;
    for (const double exponent : from_to(0, 8, 17)) thetas.push_back(std::sqrt(2 * exponent / s));
    const auto inputs = pairs_with_half_at(thetas);
    const std::string power = s == 1e6 ? "1e6" : "1e9";
    const auto stable = [s]<class T>(const Inputs<T>& in) { return lobe_exponential(static_cast<T>(s) * log_cos_half(wi(in), wo(in))); };
    places.add(
        "C1 half-vector lobe, s = " + power, inputs,
        [s]<class T>(const Inputs<T>& in) { return std::pow(normalised_half(in).z, static_cast<T>(s)); }, stable);
    const auto chord = [s]<class T>(const Inputs<T>& in) {
      const Vector3<T> h = normalised_half(in);
      // 1 - hz = |n - h|²/2, and |n - h|² from its small components: 1 - hz = (hx²+hy²)/(1+hz)
      return lobe_exponential(static_cast<T>(s) * std::log1p(-(h.x * h.x + h.y * h.y) / (1 + h.z)));
    };
    places.add_stable("C1c by the chord |n-h|", inputs, chord, stable);
    if (s < 1e9) continue;
    std::vector<Inputs<double>> mirrored;
    for (const double theta_i : {0.2, 0.8, 1.3})
      for (const double psi : thetas) {
        const Direction i = Direction::spherical(radians(theta_i), radians(0.3)),
                        o = Direction::spherical(radians(theta_i + psi), radians(0.3 + std::numbers::pi));
        mirrored.push_back({i.x(), i.y(), i.z(), o.x(), o.y(), o.z()});
      }
    places.add(
        "C1b mirror lobe, s = " + power, mirrored,
        [s]<class T>(const Inputs<T>& in) {
          const Vector3<T> i = wi(in), r{-i.x, -i.y, i.z};
          return std::pow(std::max(T(0), dot(r, wo(in))), static_cast<T>(s));
        },
        [s]<class T>(const Inputs<T>& in) { return lobe_exponential(static_cast<T>(s) * log_cos_mirror(wi(in), wo(in))); });
  }
}

void add_derivative(Places& places) {
  // cos θ, s
  places.add(
      "C2 d cos^s/ds, cosine 0 or -1e-17", {{0, 0.5}, {0, 2}, {-1e-17, 0.5}, {-1e-17, 2}, {1e-3, 0.5}, {0.5, 30}},
      []<class T>(const Inputs<T>& in) { return std::pow(in[0], in[1]) * std::log(in[0]); },
      []<class T>(const Inputs<T>& in) {
        if (!(in[0] > 0)) return T(0);
        const T log_cos = std::log(in[0]);
        return lobe_exponential(in[1] * log_cos) * log_cos;
      });
}

void add_angles(Places& places) {
  // elevation of wi, of wo, azimuth from the mirror direction
  places.add(
      "C3 θh of grazing mirrored pairs", {{1e-4, 1e-4, 1e-4}, {1e-6, 1e-6, 1e-6}, {1e-8, 1e-8, 1e-8}},
      []<class T>(const Inputs<T>& in) {
        const T a = std::numbers::pi_v<T> - in[2];
        const T hx = std::cos(in[0]) + std::cos(in[1]) * std::cos(a), hy = std::cos(in[1]) * std::sin(a);
        return std::atan2(std::hypot(hx, hy), std::sin(in[0]) + std::sin(in[1]));
      },
      []<class T>(const Inputs<T>& in) { return theta_half_from_elevations(in[0], in[1], in[2]); });
  places.add(
      "C4 θh near the normal, 1e-6 to 1e-3", pairs_with_half_at({1e-6, 1e-5, 1e-4, 1e-3}),
      []<class T>(const Inputs<T>& in) { return std::acos(std::min(T(1), normalised_half(in).z)); },
      []<class T>(const Inputs<T>& in) { return theta_half(wi(in), wo(in)); });
  std::vector<Inputs<double>> retro;
  for (const double gap : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const Direction i = Direction::spherical(radians(0.5), radians(0.2)), o = Direction::spherical(radians(0.5 + gap), radians(0.2));
    retro.push_back({i.x(), i.y(), i.z(), o.x(), o.y(), o.z()});
  }
  places.add(
      "C4b θd near retro-reflection", retro,
      []<class T>(const Inputs<T>& in) { return std::acos(std::min(T(1), dot(normalised_half(in), wi(in)))); },
      []<class T>(const Inputs<T>& in) { return theta_difference(wi(in), wo(in)); });
  // θ in degrees
  places.add(
      "C5 cos θ at 89°, 89.9°, 89.99°, 90°", {{89}, {89.9}, {89.99}, {90}},
      []<class T>(const Inputs<T>& in) { return std::cos(in[0] * (std::numbers::pi_v<T> / 180)); },
      []<class T>(const Inputs<T>& in) { return std::sin((90 - in[0]) * (std::numbers::pi_v<T> / 180)); });
}

void add_functions(Places& places) {
  places.add(
      "C6 Γ((s+1)/2)/Γ(s/2+1), s to 1e12", {{1e3}, {1e6}, {1e9}, {1e12}},
      []<class T>(const Inputs<T>& in) { return std::exp(std::lgamma((in[0] + 1) / 2) - std::lgamma(in[0] / 2 + 1)); },
      []<class T>(const Inputs<T>& in) { return gamma_ratio_half(in[0] / 2); });
  std::vector<Inputs<double>> far;
  for (const double theta_h : {0.4, 0.6, 1.0, 1.2}) far.push_back({std::cos(theta_h)});
  places.add(
      "C7 ln of a lobe that underflows, s = 1e4", far, []<class T>(const Inputs<T>& in) { return std::log(std::pow(in[0], T(1e4))); },
      []<class T>(const Inputs<T>& in) { return T(1e4) * std::log(in[0]); });
}

/// 1.46 million values over four decades, made from an index without storing them.
constexpr int sum_count = 1'458'000;
template <class T>
T value_at(int k) {
  // The golden-ratio sequence: even, and in an order that mixes small and large values.
  const double u = std::fmod(0.6180339887498949 * k, 1.0);
  return static_cast<T>(1e-2 / (1e-4 + u * u));
}

template <class T>
const std::vector<T>& values() {
  static const std::vector<T> list = [] {
    std::vector<T> out(sum_count);
    for (int k = 0; k < sum_count; ++k) out[static_cast<std::size_t>(k)] = static_cast<T>(value_at<float>(k));
    return out;
  }();
  return list;
}

void add_sums(Places& places) {
  places.add(
      "C8 sum of 1 458 000 values", {{0}},
      []<class T>(const Inputs<T>&) {
        T sum = 0;
        for (const T value : values<T>()) sum += value;
        return sum;
      },
      []<class T>(const Inputs<T>&) {
        // Blocks of 256 in T, the blocks in double at least.
        using Wide = std::conditional_t<std::is_same_v<T, float>, double, T>;
        Wide sum = 0;
        const auto& list = values<T>();
        for (std::size_t first = 0; first < list.size(); first += 256) {
          const std::size_t last = std::min(list.size(), first + 256);
          std::array<T, 8> lanes{};
          for (std::size_t k = first; k < last; ++k) lanes[k % 8] += list[k];
          T block = 0;
          for (const T lane : lanes) block += lane;
          sum += static_cast<Wide>(block);
        }
        return static_cast<T>(sum);
      },
      sum_count);
  // Six values near 1 whose spread is 1e-4.
  const auto mean = []<class T>(const Inputs<T>& in) {
    T sum = 0;
    for (const T value : in) sum += value;
    return sum / T(in.size());
  };
  places.add(
      "C9 residual squares, signal/noise 1e4", {{1, 1.0001, 0.9999, 1.00005, 0.99995, 1.00012}, {2, 2.0002, 1.9999, 2.0001, 1.9998, 2}},
      [mean]<class T>(const Inputs<T>& in) {
        T squares = 0;
        for (const T value : in) squares += value * value;
        const T m = mean(in);
        return squares - T(in.size()) * m * m;
      },
      [mean]<class T>(const Inputs<T>& in) {
        const T m = mean(in);
        T sum = 0, rest = 0;
        for (const T value : in) sum += (value - m) * (value - m), rest += value - m;
        return sum - rest * rest / T(in.size());  // what the rounding of the mean left
      });
}

void add_fits(Places& places) {
  // ρs of y = ρd + ρs cos^s θ at six angles by normal equations; the inputs are the y of ρd = 0.2, ρs = 0.3, and s = 1e-4.
  constexpr double s = 1e-4;
  constexpr std::array<double, 6> thetas{0.1, 0.4, 0.7, 1.0, 1.3, 1.5};
  Inputs<double> y;
  for (std::size_t k = 0; k < y.size(); ++k) y[k] = 0.2 + 0.3 * std::exp(s * std::log(std::cos(thetas[k])));
  places.add(
      "C10 ρs of a nearly diffuse lobe, s = 1e-4", {y},
      [thetas]<class T>(const Inputs<T>& data) {
        // The normal equations of {1, cos^s}
        T b = 0, bb = 0, sum = 0, cross = 0;
        for (std::size_t k = 0; k < data.size(); ++k) {
          const T column = std::pow(std::cos(static_cast<T>(thetas[k])), T(s));
          b += column, bb += column * column, sum += data[k], cross += column * data[k];
        }
        const T n = T(data.size());
        return (n * cross - b * sum) / (n * bb - b * b);
      },
      [thetas]<class T>(const Inputs<T>& data) {
        // {1, expm1(s ln cos)/s}, both sides freed of their means
        Inputs<T> column;
        T mean_column = 0, mean = 0;
        for (std::size_t k = 0; k < data.size(); ++k) {
          column[k] = std::expm1(T(s) * std::log(std::cos(static_cast<T>(thetas[k])))) / T(s);
          mean_column += column[k] / T(data.size()), mean += data[k] / T(data.size());
        }
        T cross = 0, square = 0;
        for (std::size_t k = 0; k < data.size(); ++k) {
          cross += (column[k] - mean_column) * (data[k] - mean);
          square += (column[k] - mean_column) * (column[k] - mean_column);
        }
        return cross / square / T(s);
      });
  places.add(
      "C11 exact norm of the lobe, s to 1e20", {{1}, {1e3}, {1e10}, {1e20}},
      []<class T>(const Inputs<T>& in) {
        return (in[0] + 2) * (in[0] + 4) / (8 * std::numbers::pi_v<T> * (std::exp2(-in[0] / 2) + in[0]));
      },
      []<class T>(const Inputs<T>& in) { return blinn_phong_exact_norm(in[0]); });
}

}  // namespace

Measured measure_precision(const Effort& effort) {
  Measured out;
  out.title = "Precision at the hard places: error against time of one evaluation (worst of each place's inputs)";
  out.time_of = "time per evaluation";
  out.error_of = "relative error";
  out.time_unit_s = 1e-9, out.time_unit = "ns";
  out.targets = {1e-5, 1e-12};
  Places places(effort, out);
  add_lobes(places);
  add_derivative(places);
  add_angles(places);
  add_functions(places);
  add_sums(places);
  add_fits(places);
  out.remarks = {"C12 to C14 (interpolation, weights from noisy data, robust starts) are no matter of precision."};
  return out;
}

}  // namespace gonio::tools::tradeoff
