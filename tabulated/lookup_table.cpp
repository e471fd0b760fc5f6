// SPDX-License-Identifier: BSD-3-Clause
// Built without contraction of products and sums (see CMakeLists.txt), so that every instruction set gives the same bits.
#include "tabulated/lookup_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/coordinates.hpp"
#include "tabulated/in_parallel.hpp"
#include "tabulated/merl_grid.hpp"
#include "tabulated/multiversion.hpp"

namespace gonio::tabulated {
namespace {

constexpr float half_pi = std::numbers::pi_v<float> / 2;

/// atan(y/x) for x, y >= 0, not both NaN: the polynomial in (y/x)² of least largest relative error on [0, 1] (1.5e-8), found by reweighted
/// least squares. 0 for 0/0, where the angle is arbitrary.
[[gnu::always_inline]] inline float first_quadrant(float y, float x) noexcept {
  constexpr float least = 1e-30f;  // instead of 0: 0/0 is 0
  const bool steep = y > x;
  const float small = y < x ? y : x, large = y < x ? x : y;
  const float t = small / (large > least ? large : least), z = t * t;
  float p = 0.002849886892363429f;
  p = p * z - 0.01606861874461174f;
  p = p * z + 0.04269150272011757f;
  p = p * z - 0.07504293322563171f;
  p = p * z + 0.10640933364629745f;
  p = p * z - 0.14203643798828125f;
  p = p * z + 0.1999261975288391f;
  p = p * z - 0.3333307206630707f;
  const float angle = t + t * (z * p);
  return steep ? half_pi - angle : angle;
}

/// The angle in [0, 90°] whose sine and cosine have these squares, which sum to 1: the polynomial in sin² of least largest relative error
/// on [0, 1/2] (5e-9), of the angle or of what it lacks to 90°. Without the division of an arc tangent, which would be as slow again.
[[gnu::always_inline]] inline float angle_of_squares(float sin2, float cos2) noexcept {
  const bool steep = sin2 > cos2;
  const float z = sin2 < cos2 ? sin2 : cos2, t = std::sqrt(z);
  float p = 0.12730520963668823f;
  p = p * z - 0.14219585061073303f;
  p = p * z + 0.11201221495866776f;
  p = p * z - 0.008713357150554657f;
  p = p * z + 0.03613096475601196f;
  p = p * z + 0.0440659336745739f;
  p = p * z + 0.07502767443656921f;
  p = p * z + 0.1666662096977234f;
  const float angle = t + t * (z * p);
  return steep ? half_pi - angle : angle;
}

/// Position = angle · scale - shift, in units of nodes; with the square root, sqrt(angle) · scale - shift.
struct Scale {
  float scale = 1, shift = 0;
};

struct Mapping {
  Parameterisation parameterisation;
  bool square_root;
  std::array<Scale, 3> axis;
};

double range_of(Parameterisation parameterisation, std::size_t axis) {
  if (axis < 2) return std::numbers::pi / 2;
  return parameterisation == Parameterisation::half_difference ? std::numbers::pi : 2 * std::numbers::pi;
}

bool is_root(const LookupLayout& layout, std::size_t axis) {
  return axis == 0 && layout.square_root && layout.parameterisation == Parameterisation::half_difference;
}

/// Nodes per range, and the first node's place in units of nodes.
std::pair<double, double> rule_of(const LookupLayout& layout, std::size_t axis) {
  const auto count = static_cast<double>(layout.count[axis]);
  if (layout.nodes == NodeRule::centre) return {count, 0.5};
  return {layout.nodes == NodeRule::ends && axis < 2 ? count - 1 : count, 0.0};
}

Mapping mapping_of(const LookupLayout& layout) {
  Mapping out{layout.parameterisation, is_root(layout, 0), {}};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [per_range, first] = rule_of(layout, a);
    const double range = range_of(layout.parameterisation, a);
    out.axis[a] = {static_cast<float>(per_range / (is_root(layout, a) ? std::sqrt(range) : range)), static_cast<float>(first)};
  }
  return out;
}

struct Vector {
  float x, y, z;
};

inline float length(float x, float y) noexcept { return std::sqrt(x * x + y * y); }

struct Position {
  float a, b, c;
};

[[gnu::always_inline]] inline Position position(const Mapping& mapping, Vector i, Vector o) noexcept {
  float a, b, c;
  if (mapping.parameterisation == Parameterisation::half_difference) {
    // brdf/coordinates.cpp, in single precision: h = wi + wo, v = wi - wo.
    const float hx = i.x + o.x, hy = i.y + o.y, hz = i.z + o.z, vx = i.x - o.x, vy = i.y - o.y, vz = i.z - o.z;
    const float radius2 = hx * hx + hy * hy, h2 = radius2 + hz * hz, v2 = vx * vx + vy * vy + vz * vz, h = std::sqrt(h2);
    a = first_quadrant(std::sqrt(radius2), hz);
    b = angle_of_squares(0.25f * v2, 0.25f * h2);
    const float y = hx * vy - hy * vx, x = -vz * h;
    const float angle = first_quadrant(std::fabs(y), std::fabs(x));
    c = (y < 0.0f) == (x < 0.0f) ? angle : 2 * half_pi - angle;  // phi_d and phi_d + 180° are one
    a = mapping.square_root ? std::sqrt(a) : a;
  } else {
    a = first_quadrant(length(i.x, i.y), i.z);
    b = first_quadrant(length(o.x, o.y), o.z);
    const float y = i.x * o.y - i.y * o.x, x = i.x * o.x + i.y * o.y;
    const float angle = first_quadrant(std::fabs(y), std::fabs(x));
    const float half_turn = x < 0.0f ? 2 * half_pi - angle : angle;
    c = y < 0.0f ? 4 * half_pi - half_turn : half_turn;
  }
  const auto on = [](float angle, const Scale& axis) { return angle * axis.scale - axis.shift; };
  return {on(a, mapping.axis[0]), on(b, mapping.axis[1]), on(c, mapping.axis[2])};
}

/// Six columns of directions to three of positions.
struct Columns {
  std::array<const float*, 3> i, o;
  std::array<float*, 3> at;
};

/// The parameterisation as a constant, so that the loop has no branch; inlined into every version of its caller.
template <Parameterisation parameterisation, bool square_root>
[[gnu::always_inline]] inline void fill(Mapping mapping, std::size_t count, const float* __restrict ix, const float* __restrict iy,
                                        const float* __restrict iz, const float* __restrict ox, const float* __restrict oy,
                                        const float* __restrict oz, float* __restrict a, float* __restrict b,
                                        float* __restrict c) noexcept {
  mapping.parameterisation = parameterisation, mapping.square_root = square_root;
  for (std::size_t k = 0; k < count; ++k) {
    const Position at = position(mapping, {ix[k], iy[k], iz[k]}, {ox[k], oy[k], oz[k]});
    a[k] = at.a, b[k] = at.b, c[k] = at.c;
  }
}

template <Parameterisation parameterisation, bool square_root>
[[gnu::always_inline]] inline void fill_positions(const Mapping& mapping, const Columns& columns, std::size_t count) noexcept {
  const auto& [i, o, at] = columns;
  fill<parameterisation, square_root>(mapping, count, i[0], i[1], i[2], o[0], o[1], o[2], at[0], at[1], at[2]);
}

GONIO_MULTIVERSION void find_positions(const Mapping& mapping, const Columns& columns, std::size_t count) noexcept {
  if (mapping.parameterisation == Parameterisation::spherical)
    fill_positions<Parameterisation::spherical, false>(mapping, columns, count);
  else if (mapping.square_root)
    fill_positions<Parameterisation::half_difference, true>(mapping, columns, count);
  else
    fill_positions<Parameterisation::half_difference, false>(mapping, columns, count);
}

inline bool is_below(float wi_z, float wo_z) noexcept { return (wi_z <= 0.0f) | (wo_z <= 0.0f); }

/// Gives pairs below the horizon the first node's place, where their value, which is not used, costs no search for known nodes. True if
/// there are any.
GONIO_MULTIVERSION bool move_from_below(const float* __restrict wi_z, const float* __restrict wo_z, std::size_t count, float* __restrict a,
                                        float* __restrict b, float* __restrict c) noexcept {
  int any = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const bool below = is_below(wi_z[k], wo_z[k]);
    a[k] = below ? 0.0f : a[k], b[k] = below ? 0.0f : b[k], c[k] = below ? 0.0f : c[k];
    any |= below;
  }
  return any != 0;
}

/// The angle of a node in degrees, exact at round numbers.
double node_degrees(const LookupLayout& layout, std::size_t axis, std::size_t node) {
  const auto [per_range, first] = rule_of(layout, axis);
  const double at = static_cast<double>(node) + first, range = axis < 2                                                 ? 90
                                                               : layout.parameterisation == Parameterisation::spherical ? 360
                                                                                                                        : 180;
  return is_root(layout, axis) ? range * at * at / (per_range * per_range) : range * at / per_range;
}

DirectionPair node_directions(const LookupLayout& layout, std::size_t i, std::size_t j, std::size_t k) {
  const double a = node_degrees(layout, 0, i), b = node_degrees(layout, 1, j), c = node_degrees(layout, 2, k);
  if (layout.parameterisation == Parameterisation::half_difference) return directions({degrees(a), degrees(0), degrees(b), degrees(c)});
  const GonioAngles angles{degrees(a), degrees(0), degrees(b), degrees(c)};
  return {angles.wi(), angles.wo()};
}

LookupGrid sampled(const Brdf& brdf, const LookupLayout& layout, Storage storage, int threads) {
  const std::size_t channels = brdf.channels().size(), row = layout.count[1] * layout.count[2];
  GridShape shape{layout.count, {AxisEnd::clamped, AxisEnd::clamped, AxisEnd::periodic}, channels};
  std::vector<double> values(shape.node_count() * channels, std::numeric_limits<double>::quiet_NaN());
  in_parallel(layout.count[0], threads, [&](std::size_t i) {
    std::vector<Direction> wi, wo;
    std::vector<std::size_t> nodes;
    for (std::size_t j = 0; j < layout.count[1]; ++j)
      for (std::size_t k = 0; k < layout.count[2]; ++k) {
        const DirectionPair pair = node_directions(layout, i, j, k);
        if (!above_horizon(pair)) continue;
        nodes.push_back(i * row + j * layout.count[2] + k);
        wi.push_back(pair.wi), wo.push_back(pair.wo);
      }
    std::vector<double> f(nodes.size() * channels);
    brdf.eval(wi, wo, f);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      std::copy_n(f.begin() + static_cast<std::ptrdiff_t>(n * channels), channels,
                  values.begin() + static_cast<std::ptrdiff_t>(nodes[n] * channels));
  });
  return {shape, values, storage};
}

/// Pairs whose coordinates are kept at once.
constexpr std::size_t batch = 1024;

}  // namespace

LookupTable::LookupTable(const Brdf& brdf, LookupLayout layout, Storage storage, int threads)
    : layout_(layout), channels_(brdf.channels()), grid_(sampled(brdf, layout, storage, threads)) {}

void LookupTable::coordinates(const DirectionColumns& wi, const DirectionColumns& wo, std::array<std::span<float>, 3> out) const {
  const auto from = [](const DirectionColumns& of) { return std::array{of.xyz[0].data(), of.xyz[1].data(), of.xyz[2].data()}; };
  find_positions(mapping_of(layout_), {from(wi), from(wo), {out[0].data(), out[1].data(), out[2].data()}}, wi.size());
}

void LookupTable::eval(const DirectionColumns& wi, const DirectionColumns& wo, Interpolation interpolation, std::span<float> out) const {
  const std::size_t channels = channels_.size();
  std::array<std::array<float, batch>, 3> at;
  for (std::size_t first = 0; first < wi.size(); first += batch) {
    const std::size_t count = std::min(batch, wi.size() - first);
    const auto part = [&](const DirectionColumns& of) {
      return DirectionColumns{{of.xyz[0].subspan(first, count), of.xyz[1].subspan(first, count), of.xyz[2].subspan(first, count)}};
    };
    coordinates(part(wi), part(wo), {std::span(at[0]), std::span(at[1]), std::span(at[2])});
    const float *const wi_z = wi.xyz[2].data() + first, *const wo_z = wo.xyz[2].data() + first;
    const bool some_below = move_from_below(wi_z, wo_z, count, at[0].data(), at[1].data(), at[2].data());
    const auto column = [&](std::size_t a) { return std::span<const float>(at[a]).first(count); };
    float* const values = out.data() + first * channels;
    grid_.lookup({{column(0), column(1), column(2)}}, interpolation, {values, count * channels});
    for (std::size_t k = 0; some_below && k < count; ++k)
      if (is_below(wi_z[k], wo_z[k])) std::fill_n(values + k * channels, channels, 0.0f);
  }
}

void LookupTable::eval_one(const std::array<float, 3>& wi, const std::array<float, 3>& wo, Interpolation interpolation,
                           std::span<float> out) const {
  if (is_below(wi[2], wo[2])) {
    std::fill(out.begin(), out.end(), 0.0f);
    return;
  }
  const Position at = position(mapping_of(layout_), {wi[0], wi[1], wi[2]}, {wo[0], wo[1], wo[2]});
  grid_.at({at.a, at.b, at.c}, interpolation, out);
}

}  // namespace gonio::tabulated
