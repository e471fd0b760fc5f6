// SPDX-License-Identifier: BSD-3-Clause
#include "tools/residual_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "brdf/error.hpp"
#include "tools/gnuplot.hpp"

namespace gonio::tools {
namespace {

using fitting::ResidualCell;
using fitting::ResidualMap;

constexpr std::size_t most_panels = 6;
constexpr double beyond_chance = 3;  // standard deviations of a cell's mean

/// Mean square of the means, each by its number of samples.
double missed(const std::vector<ResidualCell>& cells) {
  double sum = 0, count = 0;
  for (const ResidualCell& cell : cells) {
    const double n = static_cast<double>(cell.count);
    sum += n * cell.mean * cell.mean, count += n;
  }
  return count > 0 ? sum / count : 0;
}

/// The channels drawn, in their order.
std::vector<std::size_t> channels_of(const ResidualMap& map) {
  std::vector<std::size_t> out(map.channel.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) { return missed(map.channel[a]) > missed(map.channel[b]); });
  out.resize(std::min(out.size(), most_panels));
  std::sort(out.begin(), out.end());
  return out;
}

/// A round number that few means exceed, 3 at least: a fit that is right looks pale.
double scale_of(const ResidualMap& map, const std::vector<std::size_t>& channels) {
  double largest = 3;
  for (const std::size_t c : channels)
    for (const ResidualCell& cell : map.channel[c]) largest = std::max(largest, std::abs(cell.mean));
  const double decade = std::pow(10.0, std::floor(std::log10(largest)));
  for (const double step : {1.0, 2.0, 3.0, 5.0})
    if (largest <= step * decade) return step * decade;
  return 10 * decade;
}

std::string number(double mean) { return std::abs(mean) < 9.95 ? fmt::format("{:+.1f}", mean) : fmt::format("{:+.0f}", mean); }

std::string script(const fitting::FitResult& result, const std::string& output) {
  const ResidualMap& map = result.residuals;
  const std::vector<std::size_t> channels = channels_of(map);
  const std::size_t columns = channels.size() == 1 ? 1 : 2, rows = (channels.size() + columns - 1) / columns;
  const double scale = scale_of(map, channels);
  // Pixels: equal tiles of two squares side by side, with a heading above and the scale at the right.
  const double tile = channels.size() == 1 ? 1100 : 760, tile_height = tile / 2 + 65, heading = 70, scale_width = 130;
  const double width = tile * static_cast<double>(columns) + scale_width, height = tile_height * static_cast<double>(rows) + heading;
  std::string text;
  for (const std::size_t c : channels) {
    text += fmt::format("$map{} << EOD\n", c);
    for (std::size_t k = 0; k < map.channel[c].size(); ++k)
      text += map.channel[c][k].count > 0
                  ? fmt::format("{} {} {:.4g}\n", ResidualMap::theta_o_deg(k), ResidualMap::theta_i_deg(k), map.channel[c][k].mean)
                  : fmt::format("{} {} NaN\n", ResidualMap::theta_o_deg(k), ResidualMap::theta_i_deg(k));
    text += "EOD\n";
  }
  const char* unit = map.sigma_known ? "σ of one reading" : "rms residual of the channel";
  text += fmt::format(
      "set terminal pngcairo size {},{} font 'DejaVu Sans,12' background '#ffffff'\nset output {}\nset multiplot\n"
      "set label 1 {} at screen 0.5,{} center noenhanced font ',14'\nset label 2 {} at screen 0.5,{} center noenhanced tc rgb '#555555'\n",
      width, height, gnuplot_quoted(output),
      gnuplot_quoted(fmt::format("Where {} misses the data: mean of data - fit, in units of the {}", result.model, unit)), 1 - 20 / height,
      gnuplot_quoted(fmt::format("numbers: beyond chance by {:.0f} standard deviations   grey: no sample{}", beyond_chance,
                                 channels.size() < map.channel.size()
                                     ? fmt::format("   {} of {} channels, those missed most", channels.size(), map.channel.size())
                                     : "")),
      1 - 46 / height);
  text += fmt::format(
      "unset key\nset xrange [-90:90]\nset yrange [0:90]\nset xtics 30 format '%g°' out nomirror\nset ytics 30 format '%g°' out nomirror\n"
      "set mxtics 3\nset mytics 3\nset border lc rgb '#444444'\nset palette defined (-1 '#2166ac', -0.5 '#92c5de', 0 '#f7f7f7', 0.5 "
      "'#f4a582', 1 "
      "'#b2182b')\nset cbrange [-{0}:{0}]\nset format cb '%g'\nset colorbox user origin screen {1},0.2 size screen {2},0.6\n"
      "set object 1 rectangle from -90,0 to 90,90 behind fillcolor rgb '#c8c8c8' fillstyle solid noborder\n"
      "set arrow 1 from 0,0 to 0,90 nohead front lc rgb '#444444'\n"
      "set xlabel 'light side       outgoing zenith angle       mirror side'\nset ylabel 'incident zenith angle'\n",
      scale, 1 - 0.85 * scale_width / width, 0.16 * scale_width / width);
  for (std::size_t panel = 0; panel < channels.size(); ++panel) {
    const std::vector<ResidualCell>& cells = map.channel[channels[panel]];
    const double x = tile * static_cast<double>(panel % columns), y = heading + tile_height * static_cast<double>(panel / columns);
    text += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen {}\n",
                        (x + 90) / width, (x + tile - 10) / width, 1 - (y + 25) / height, 1 - (y + tile_height - 70) / height);
    text += fmt::format("set title {} noenhanced offset 0,-0.5\n", gnuplot_quoted("channel " + result.channels[channels[panel]].name));
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (std::abs(cells[k].mean) * std::sqrt(static_cast<double>(cells[k].count)) <= beyond_chance) continue;
      const bool dark = std::abs(cells[k].mean) > 0.75 * scale;
      text += fmt::format("set label {} '{}' at {},{} center front font ',{}' tc rgb '{}'\n", 10 + k, number(cells[k].mean),
                          ResidualMap::theta_o_deg(k), ResidualMap::theta_i_deg(k), channels.size() == 1 ? 11 : 8,
                          dark ? "#ffffff" : "#000000");
    }
    text += fmt::format("plot $map{} using 1:2:3 with image\nunset label\nunset colorbox\n", channels[panel]);
  }
  return text + "unset multiplot\n";
}

}  // namespace

void draw_residuals(const fitting::FitResult& result, const std::filesystem::path& png) {
  if (result.residuals.n_samples == 0) throw Error(ErrorKind::usage, {png.string(), "no residual", "a fit of samples or a table"});
  draw_with_gnuplot(png, [&](const std::filesystem::path& output) { return script(result, output.string()); });
}

}  // namespace gonio::tools
