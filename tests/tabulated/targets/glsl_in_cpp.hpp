// SPDX-License-Identifier: BSD-3-Clause
// As much of GLSL as the exported functions use, in double precision, so that a C++ compiler can run them.
#pragma once

#include <cmath>

struct vec3 {
  double v[3];
  vec3(double a, double b, double c) : v{a, b, c} {}
  explicit vec3(double a) : v{a, a, a} {}
  double operator[](int k) const { return v[k]; }
};
inline vec3 operator+(vec3 a, vec3 b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline vec3 operator*(vec3 a, vec3 b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
inline vec3 operator*(vec3 a, double b) { return {a[0] * b, a[1] * b, a[2] * b}; }
inline vec3 operator*(double b, vec3 a) { return a * b; }
inline vec3 operator/(vec3 a, double b) { return {a[0] / b, a[1] / b, a[2] / b}; }
inline double dot(vec3 a, vec3 b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline vec3 normalize(vec3 a) { return a / std::sqrt(dot(a, a)); }
inline double mix(double a, double b, double t) { return a * (1 - t) + b * t; }
inline vec3 mix(vec3 a, vec3 b, double t) { return a * (1 - t) + b * t; }
inline double max(double a, double b) { return a > b ? a : b; }
inline double clamp(double a, double low, double high) { return a < low ? low : a > high ? high : a; }
using std::exp;
using std::log;
using std::pow;
using std::sqrt;
#define float double
