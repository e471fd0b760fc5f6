// SPDX-License-Identifier: BSD-3-Clause
#include "tools/difference_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tabulated/formats/brdf_exr_channels.hpp"
#include "tabulated/formats/exr_image.hpp"
#include "tools/gnuplot.hpp"

namespace gonio::tools {
namespace {

/// A round number no smaller than what 98 % of the pixels show, in per cent.
double scale_of(const std::vector<float>& differences) {
  std::vector<float> sizes;
  for (const float d : differences)
    if (std::isfinite(d)) sizes.push_back(std::fabs(d));
  constexpr double largest = 200;
  if (sizes.empty()) return largest;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  const double wanted = std::max(100 * static_cast<double>(*at), 1e-10);
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 2.0, 5.0})
    if (wanted <= step * decade) return std::min(step * decade, largest);
  return std::min(10 * decade, largest);
}

std::string script(const fitting::DifferenceImage& image, const std::string& title, const std::string& output) {
  const std::size_t columns = image.discs.size() == 4 ? 2 : std::min<std::size_t>(3, image.discs.size()),
                    rows = (image.discs.size() + columns - 1) / columns;
  const double scale = scale_of(image.mean), half = static_cast<double>(image.size) / 2;
  std::string text;
  for (std::size_t disc = 0; disc < image.discs.size(); ++disc) {
    text += fmt::format("$disc{} << EOD\n", disc);
    for (std::size_t row = 0; row < image.size; ++row) {
      for (std::size_t column = 0; column < image.size; ++column) {
        const double d = static_cast<double>(image.mean[row * image.width() + disc * image.size + column]);
        text += std::isfinite(d) ? fmt::format("{:.4g} ", 100 * d) : "NaN ";
      }
      text += '\n';
    }
    text += "EOD\n";
  }
  // Pixels: the picture is put together from equal tiles, with a heading above and the scale at the right.
  const double tile = 390, heading = 60, scale_width = 140;
  const double width = tile * static_cast<double>(columns) + scale_width, height = tile * static_cast<double>(rows) + heading;
  text += fmt::format(
      "set terminal pngcairo size {},{} font 'DejaVu Sans,13' background '#ffffff'\nset output {}\nset multiplot\n"
      "set label 9 {} at screen 0.5,{} center noenhanced\nset lmargin 0\nset rmargin 0\nset tmargin 1.6\nset bmargin 0\n",
      width, height, gnuplot_quoted(output), gnuplot_quoted(title), 1 - 20 / height);
  text += fmt::format(
      "unset border\nunset xtics\nunset ytics\nunset key\nset xrange [{0}:{1}]\nset yrange [{1}:{0}]\n"
      "set palette defined (-1 '#2166ac', -0.5 '#92c5de', 0 '#f7f7f7', 0.5 '#f4a582', 1 '#b2182b')\nset cbrange [-{2}:{2}]\n"
      "set format cb '%+g %%'\nset colorbox user origin screen {4},0.15 size screen {5},0.7\nset object 1 circle at {3},{3} size {3} "
      "behind fillcolor rgb '#c8c8c8' fillstyle solid noborder\n",
      -0.06 * static_cast<double>(image.size), 1.06 * static_cast<double>(image.size), scale, half, 1 - 0.85 * scale_width / width,
      0.15 * scale_width / width);
  for (int ring = 1; ring <= 3; ++ring)
    text += fmt::format("set object {} circle at {},{} size {} front fillcolor rgb '#888888' fillstyle empty border\n", ring + 1, half,
                        half, half * ring / 3);
  for (std::size_t disc = 0; disc < image.discs.size(); ++disc) {
    const auto& [theta_i, phi_i] = image.discs[disc];
    const std::string azimuth = phi_i != 0 ? fmt::format(", azimuth {:.4g}°", phi_i) : "";
    text += fmt::format("set title 'incidence {:.4g}°{}'\n", theta_i, azimuth);
    text += fmt::format("set label 1 '' at {},{} point pt 6 ps 1.6 lw 2 lc rgb '#000000' front\n", half * (1 - theta_i / 90), half);
    text += fmt::format("set label 2 '' at {},{} point pt 2 ps 1.6 lw 2 lc rgb '#000000' front\n", half * (1 + theta_i / 90), half);
    text += fmt::format("set origin {},{}\nset size ratio -1 {},{}\n", tile * static_cast<double>(disc % columns) / width,
                        1 - (heading + tile * static_cast<double>(disc / columns + 1)) / height, tile / width, tile / height);
    text += fmt::format("plot $disc{} matrix using ($1+0.5):($2+0.5):3 with image\n", disc);
    text += "unset label 9\nunset colorbox\n";  // drawn once
  }
  return text + "unset multiplot\n";
}

}  // namespace

void draw_difference_png(const fitting::DifferenceImage& image, const std::string& title, const std::filesystem::path& png) {
  draw_with_gnuplot(png, [&](const std::filesystem::path& output) { return script(image, title, output.string()); });
}

void write_difference_exr(const fitting::DifferenceImage& image, const Channels& channels, const std::filesystem::path& exr) {
  tabulated::ExrImage out{image.width(), image.size, {}, {}};
  const std::vector<std::string> names = tabulated::exr_channel_names(channels);
  for (std::size_t c = 0; c < names.size(); ++c) out.channels.emplace_back(names[c], image.differences[c]);
  if (std::find(names.begin(), names.end(), "Y") == names.end() && std::find(names.begin(), names.end(), "R") == names.end())
    out.channels.emplace_back("Y", image.mean);
  std::string incidences, azimuths;
  for (const auto& [theta_i, phi_i] : image.discs) {
    incidences += fmt::format("{}{}", incidences.empty() ? "" : ", ", theta_i);
    azimuths += fmt::format("{}{}", azimuths.empty() ? "" : ", ", phi_i);
  }
  out.attributes = {{"quantity", "2 (b - a) / (|a| + |b|)"},
                    {"theta_i_deg", incidences},
                    {"phi_i_deg", azimuths},
                    {"disc", "radius theta_o, edge 90 deg; light to the left, mirror direction to the right"}};
  tabulated::write_exr_image(out, exr);
}

}  // namespace gonio::tools
