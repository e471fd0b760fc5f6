// SPDX-License-Identifier: BSD-3-Clause
// The plot: error against time, log-log, one small plot a panel, the key below them all.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tools/gnuplot.hpp"
#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {
namespace {

// Colours of Okabe and Ito, told apart by the colour-blind; the marker differs too.
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#444444"};
constexpr int markers[] = {7, 5, 9, 13, 11, 15, 6, 4};
constexpr std::size_t styles = std::size(colours);

/// Beyond the eighth method a marker comes again in another colour.
const char* colour(std::size_t method) { return colours[(method + 3 * (method / styles)) % styles]; }

/// Larger errors, and results that are no number, stand on this line at the top.
constexpr double useless = 10;

double shown(const Point& point) { return std::clamp(point.error.value_or(useless), std::numeric_limits<double>::min(), useless); }

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
};

/// A power of ten below (-1) or above (+1) a value.
double decade(double value, int side) {
  const double exponent = std::log10(value);
  return std::pow(10.0, side < 0 ? std::floor(exponent) : std::ceil(exponent));
}

constexpr std::size_t key_columns = 3;
constexpr double key_line = 0.03;  // of the height of the picture

/// The title above all panels, and below them what marker stands for what method. Drawn once: labels are unset after the first panel.
std::string heading_and_key(const Measured& measured, const std::vector<std::string>& methods, double foot) {
  std::string text = fmt::format("set label {} at screen 0.5,0.98 center font ',15' noenhanced\n", gnuplot_quoted(measured.title));
  const auto place = [&](std::size_t k) {
    return fmt::format("at screen {},{} left", 0.06 + 0.32 * static_cast<double>(k % key_columns),
                       foot - 0.03 - key_line * static_cast<double>(k / key_columns));
  };
  for (std::size_t m = 0; m < methods.size(); ++m)
    text += fmt::format("set label {} {} point pt {} ps 1.2 lc rgb '{}' offset character 1.2,0 noenhanced\n", gnuplot_quoted(methods[m]),
                        place(m), markers[m % styles], colour(m));
  return text + fmt::format("set label '— Pareto front{}' {} textcolor rgb '#777777' noenhanced\n",
                            measured.by_size ? "" : "; bars: fastest and slowest run", place(methods.size()));
}

double cheapest(const Point& point, const Measured& measured) { return measured.by_size ? cost(point, true) : point.time.least_s; }
double dearest(const Point& point, const Measured& measured) { return measured.by_size ? cost(point, true) : point.time.most_s; }

double least_floor(const Panel& panel) {
  double least = useless;
  for (const Line& floor : panel.error_floors) least = std::min(least, floor.value);
  return least;
}

std::string data_block(const std::string& name, const std::vector<const Point*>& points, const Measured& measured, double least_error) {
  const double unit = measured.time_unit_s;
  std::string text = fmt::format("${} << EOD\n", name);
  for (const Point* point : points)
    text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} \"{}\"\n", cost(*point, measured.by_size) / unit, std::max(shown(*point), least_error),
                        cheapest(*point, measured) / unit, dearest(*point, measured) / unit,
                        measured.by_size ? point->method + " " + point->setting : point->setting);
  return text + "EOD\n";
}

}  // namespace

std::string plot_script(const Measured& measured, const std::string& terminal, const std::string& output) {
  std::vector<const Panel*> panels;
  for (const Panel& panel : measured.panels)
    if (panel.drawn) panels.push_back(&panel);
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(panels.size()))));
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  std::vector<std::string> methods;
  for (const Point& point : measured.points)
    if (std::find(methods.begin(), methods.end(), point.method) == methods.end()) methods.push_back(point.method);
  const auto in_panel = [&](const Panel& panel, auto&& wanted) {
    std::vector<const Point*> out;
    for (const Point& point : measured.points)
      if (point.panel == panel.name && wanted(point)) out.push_back(&point);
    return out;
  };

  Range time, error;
  error.add(useless);
  for (const Panel* panel : panels) {
    time.add(panel->limit.value / measured.time_unit_s);
    error.add(least_floor(*panel));
    for (const Point* point : in_panel(*panel, [](const Point&) { return true; })) {
      time.add(cheapest(*point, measured) / measured.time_unit_s), time.add(dearest(*point, measured) / measured.time_unit_s);
      if (shown(*point) > 0.01 * least_floor(*panel)) error.add(shown(*point));
    }
  }
  const double bottom = decade(error.low / 20, -1), left = decade(time.low / 2, -1), right = decade(time.high * 1.5, 1);

  const double foot = key_line * static_cast<double>((methods.size() + key_columns) / key_columns) + 0.03, head = 0.05;
  const double width = 1.0 / static_cast<double>(columns), height = (1 - foot - head) / static_cast<double>(rows);

  // Wide enough for the key, and every panel large enough to read.
  std::string text = fmt::format("set terminal {} size {},{} background '#ffffff'\nset output ", terminal,
                                 std::max<std::size_t>(1500, 420 * columns), std::max<std::size_t>(800, 120 + 400 * rows)) +
                     gnuplot_quoted(output) + "\nset encoding utf8\n";
  for (std::size_t p = 0; p < panels.size(); ++p) {
    for (std::size_t m = 0; m < methods.size(); ++m)
      text += data_block(fmt::format("p{}m{}", p, m), in_panel(*panels[p], [&](const Point& q) { return q.method == methods[m]; }),
                         measured, least_floor(*panels[p]) / 4);
    auto front = in_panel(*panels[p], [](const Point& q) { return q.on_front; });
    std::sort(front.begin(), front.end(),
              [&](const Point* a, const Point* b) { return cost(*a, measured.by_size) < cost(*b, measured.by_size); });
    text += data_block(fmt::format("p{}front", p), front, measured, least_floor(*panels[p]) / 4);
  }
  text += "set multiplot\n" + heading_and_key(measured, methods, foot);
  text += fmt::format(
      "set logscale xy\nset format x '10^{{%L}}'\nset format y '10^{{%L}}'\nset grid lc rgb '#e4e4e4' lt 1\nset border lc rgb '#444444'\n"
      "set xrange [{}:{}]\nset yrange [{}:{}]\nset ytics 100\nset bars 0.5\nunset key\nset lmargin 9\nset rmargin 2\nset bmargin 3.2\nset "
      "tmargin 2\n",
      left, right, bottom, useless * 100);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Panel& panel = *panels[p];
    const std::size_t row = p / columns, column = p % columns;
    text += fmt::format("set origin {},{}\nset size {},{}\n", width * static_cast<double>(column),
                        foot + height * static_cast<double>(rows - 1 - row), width, height);
    text += fmt::format("set title {} font ',12' offset 0,-0.6 noenhanced\n", gnuplot_quoted(panel.name));
    text += fmt::format("set xlabel {} offset 0,0.4 noenhanced\nset ylabel {} offset 1,0 noenhanced\n",
                        gnuplot_quoted(fmt::format("{} [{}]", measured.time_of, measured.time_unit)), gnuplot_quoted(measured.error_of));
    const double limit = panel.limit.value / measured.time_unit_s;
    text += fmt::format(
        "set arrow from {0},graph 0 to {0},graph 1 nohead lc rgb '#888888' dt 3 lw 1.5\nset label {1} at {0},graph 0.85 rotate by 90 "
        "right offset character 0.8,0 font ',9' textcolor rgb '#666666' noenhanced\n",
        limit, gnuplot_quoted(panel.limit.label));
    for (const Line& floor : panel.error_floors)
      text += fmt::format(
          "set arrow from graph 0,first {0} to graph 1,first {0} nohead lc rgb '#888888' dt 2 lw 1.5\nset label {1} at graph 0.98,first "
          "{0} "
          "right offset character 0,-0.7 font ',9' textcolor rgb '#666666' noenhanced\n",
          floor.value, gnuplot_quoted(floor.label));
    text += fmt::format(
        "set arrow from graph 0,first {0} to graph 1,first {0} nohead lc rgb '#d0d0d0' lw 1\nset label 'useless: error above {0}, or no "
        "number' at graph 0.98,first {0} right offset character 0,0.6 font ',9' textcolor rgb '#888888' noenhanced\n",
        useless);
    text += fmt::format("plot $p{}front using 1:2 with lines lw 2 lc rgb '#bbbbbb'", p);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (in_panel(panel, [&](const Point& q) { return q.method == methods[m]; }).empty()) continue;
      text += fmt::format(", $p{}m{} using 1:2:3:4 with xerrorbars pt {} ps 0.9 lw 1.2 lc rgb '{}'", p, m, markers[m % styles], colour(m));
    }
    text += fmt::format(
        ", $p{}front using 1:2:5 with labels left offset character 0.7,0.5 font ',9' textcolor rgb '#333333' noenhanced\nunset "
        "label\nunset arrow\n",
        p);
  }
  return text + "unset multiplot\n";
}

}  // namespace gonio::tools::tradeoff
