// SPDX-License-Identifier: BSD-3-Clause
// Vectors of GLSL in double precision: as much as MaterialX's microfacet functions use, so that a C++ compiler can run them.
#pragma once

#include <cmath>

struct vec2 {
  double x, y;
  vec2() : x(0), y(0) {}
  vec2(double a, double b) : x(a), y(b) {}
  explicit vec2(double a) : x(a), y(a) {}
};
struct vec3 {
  double x, y, z;
  vec3() : x(0), y(0), z(0) {}
  vec3(double a, double b, double c) : x(a), y(b), z(c) {}
  explicit vec3(double a) : x(a), y(a), z(a) {}
};
struct vec4 {
  double x, y, z, w;
  vec4() : x(0), y(0), z(0), w(0) {}
  vec4(double a, double b, double c, double d) : x(a), y(b), z(c), w(d) {}
};

inline vec2 each(vec2 a, vec2 b, auto f) { return {f(a.x, b.x), f(a.y, b.y)}; }
inline vec3 each(vec3 a, vec3 b, auto f) { return {f(a.x, b.x), f(a.y, b.y), f(a.z, b.z)}; }
inline vec4 each(vec4 a, vec4 b, auto f) { return {f(a.x, b.x), f(a.y, b.y), f(a.z, b.z), f(a.w, b.w)}; }
inline vec2 spread(vec2, double a) { return {a, a}; }
inline vec3 spread(vec3, double a) { return {a, a, a}; }
inline vec4 spread(vec4, double a) { return {a, a, a, a}; }

template <class V>
concept Vector = requires(V v) {
  spread(v, 1.0);
};

#define GLSL_OPERATOR(op)                                         \
  template <Vector V>                                             \
  V operator op(V a, V b) {                                       \
    return each(a, b, [](double p, double q) { return p op q; }); \
  }                                                               \
  template <Vector V>                                             \
  V operator op(V a, double b) {                                  \
    return a op spread(a, b);                                     \
  }                                                               \
  template <Vector V>                                             \
  V operator op(double a, V b) {                                  \
    return spread(b, a) op b;                                     \
  }
GLSL_OPERATOR(+)
GLSL_OPERATOR(-)
GLSL_OPERATOR(*)
GLSL_OPERATOR(/)
template <Vector V>
V operator-(V a) {
  return 0.0 - a;
}

inline double max(double a, double b) { return a > b ? a : b; }
inline double min(double a, double b) { return a < b ? a : b; }
inline double clamp(double a, double low, double high) { return min(max(a, low), high); }
inline double mix(double a, double b, double t) { return a + (b - a) * t; }
template <Vector V>
V max(V a, double b) {
  return each(a, a, [b](double p, double) { return max(p, b); });
}
template <Vector V>
V clamp(V a, double low, double high) {
  return each(a, a, [=](double p, double) { return clamp(p, low, high); });
}
template <Vector V>
V sqrt(V a) {
  return each(a, a, [](double p, double) { return std::sqrt(p); });
}
template <Vector V>
V mix(V a, V b, double t) {
  return a + (b - a) * t;
}
template <Vector V>
V mix(V a, V b, V t) {
  return a + (b - a) * t;
}
inline double dot(vec2 a, vec2 b) { return a.x * b.x + a.y * b.y; }
inline double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline vec3 cross(vec3 a, vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline vec3 normalize(vec3 a) { return a / std::sqrt(dot(a, a)); }
inline vec3 reflect(vec3 a, vec3 n) { return a - 2.0 * dot(a, n) * n; }
using std::pow;
using std::sqrt;
#define float double
