// SPDX-License-Identifier: BSD-3-Clause
#include "tools/lobe_picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "brdf/error.hpp"
#include "tools/gnuplot.hpp"

namespace gonio::tools {
namespace {

struct Point {
  double theta_o_deg, f, u, fitted;
};

/// Samples within half a degree of the plane of incidence, by incidence in tenths of a degree.
std::map<int, std::vector<Point>> points_in_plane(const Dataset& samples, const AnalyticBrdf& fitted) {
  constexpr double half_a_degree = 0.0087;
  std::map<int, std::vector<Point>> out;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const GonioAngles& a = samples.angles[k];
    const Angle turn = a.phi_o - a.phi_i;
    const double f = samples.f[0][k];
    // At normal incidence every direction is in the plane: take the one of the bench's x axis.
    const double off_plane = std::fabs(std::sin(turn.radians()) * a.theta_o.sin());
    if (off_plane > half_a_degree || !(f > 0)) continue;
    const double u = samples.u.empty() ? NAN : samples.u[0][k];
    const double sign = turn.cos() <= 0 ? 1 : -1;
    out[static_cast<int>(std::lround(a.theta_i.degrees() * 10))].push_back({sign * a.theta_o.degrees(), f, u, fitted.eval(a)[0]});
  }
  // Incidences that only reciprocal partners visit have a point or two: they would hide the lobes.
  constexpr std::size_t a_lobe = 6;
  const auto most =
      std::max_element(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (most != out.end() && most->second.size() >= a_lobe)
    std::erase_if(out, [](const auto& entry) { return entry.second.size() < a_lobe; });
  for (auto& [incidence, points] : out)
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.theta_o_deg < b.theta_o_deg; });
  return out;
}

std::string script(const std::map<int, std::vector<Point>>& in_plane, const Dataset& samples, const AnalyticBrdf& fitted,
                   const std::filesystem::path& png) {
  static const char* const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"};
  std::string text;
  int index = 0;
  for (const auto& [incidence, points] : in_plane) {
    text += fmt::format("$points{} << EOD\n", index);
    for (const Point& p : points)
      text += fmt::format("{} {} {} {} {}\n", p.theta_o_deg, p.f, std::isnan(p.u) ? 0 : 2 * p.u, 100 * (p.f / p.fitted - 1),
                          std::isnan(p.u) ? 0 : 200 * p.u / p.fitted);
    text += fmt::format("EOD\n$curve{} << EOD\n", index);
    for (int k = -894; k <= 894; ++k) {
      const double theta = k / 10.0;
      const GonioAngles a{degrees(incidence / 10.0), degrees(0), degrees(std::fabs(theta)), degrees(theta < 0 ? 0 : 180)};
      text += fmt::format("{} {}\n", theta, fitted.eval(a)[0]);
    }
    text += "EOD\n";
    ++index;
  }
  double lowest = INFINITY, highest = 0;
  for (const auto& [incidence, points] : in_plane)
    for (const Point& p : points) lowest = std::fmin(lowest, p.f), highest = std::fmax(highest, p.f);
  std::string parameters;
  for (std::size_t k = 0; k < fitted.values()[0].size(); ++k)
    parameters += fmt::format("  {} = {:.4g}", fitted.model().parameters[k].name, fitted.values()[0][k]);
  text += fmt::format("set terminal pngcairo size 1400,1000 font 'DejaVu Sans,13' background '#ffffff'\nset output {}\n",
                      gnuplot_quoted(png.string()));
  text +=
      "set multiplot\nset lmargin 11\nset rmargin 3\nset grid lc rgb '#dddddd' lt 1\nset xrange [-90:90]\nset xtics 15\nset border lc rgb "
      "'#444444'\nset style fill transparent solid 0.3\n";
  text += fmt::format(
      "set origin 0,0.36\nset size 1,0.64\nset bmargin 0.5\nset tmargin 4\nset logscale y\nset yrange [{}:{}]\nset format y '%g'\nset "
      "format x ''\nset ylabel "
      "'f_r  [1/sr]'\nset key top left spacing 1.2\nset title \"{} samples and fitted {} in the plane of incidence\\n{}{}\" noenhanced\n",
      lowest / 1.6, highest * 1.6, samples.simulated ? "Simulated" : "Measured", fitted.model().name,
      parameters.substr(std::min<std::size_t>(2, parameters.size())), "   (lines: fit, points: measured, bars: k = 2)");
  text += "plot ";
  index = 0;
  for (const auto& [incidence, points] : in_plane) {
    const char* colour = colours[index % 6];
    text += fmt::format(
        "{}$curve{} using 1:2 with lines lw 1.6 lc rgb '{}' title 'incidence {:g}°', $points{} using 1:2:3 with yerrorbars pt 7 ps 0.7 lc "
        "rgb '{}' notitle",
        index ? ", " : "", index, colour, incidence / 10.0, index, colour);
    ++index;
  }
  text +=
      "\nset origin 0,0\nset size 1,0.36\nset tmargin 0.5\nset bmargin 4\nunset logscale y\nset autoscale y\nunset title\nunset key\nset "
      "format x "
      "'%g°'\nset xlabel 'zenith angle of the outgoing direction (positive: specular side)'\nset ylabel 'measured / fit - 1  [%]'\nplot 0 "
      "with lines lc rgb '#444444'";
  for (index = 0; index < static_cast<int>(in_plane.size()); ++index)
    text += fmt::format(", $points{} using 1:4:5 with yerrorbars pt 7 ps 0.6 lc rgb '{}'", index, colours[index % 6]);
  return text + "\nunset multiplot\n";
}

}  // namespace

void draw_lobe(const Dataset& samples, const AnalyticBrdf& fitted, const std::filesystem::path& png) {
  const auto in_plane = points_in_plane(samples, fitted);
  if (in_plane.empty()) throw Error(ErrorKind::input, {png.string(), "no sample in the plane of incidence", "at least one"});
  draw_with_gnuplot(png, [&](const std::filesystem::path& output) { return script(in_plane, samples, fitted, output); });
}

}  // namespace gonio::tools
