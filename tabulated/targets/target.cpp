// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/target.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "brdf/error.hpp"
#include "tabulated/targets/list.hpp"

namespace gonio::tabulated::targets {

const std::vector<RenderTarget>& render_targets() {
  static const std::vector<RenderTarget> list{
      blender_target(),           //
      disney_target(),            //
      glsl_target(),              //
      gltf_target(),              //
      mitsuba_target(),           //
      open_pbr_target(),          //
      osl_target(),               //
      pbrt_target(),              //
      radiance_plastic_target(),  //
      radiance_target(),          //
      standard_surface_target(),  //
  };
  return list;
}

Widths widths(double alpha, double aspect) { return {alpha / aspect, alpha * aspect}; }

std::string real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string triple(const std::array<double, 3>& colour, std::string_view between) {
  return fmt::format("{}{}{}{}{}", real(colour[0]), between, real(colour[1]), between, real(colour[2]));
}

std::string commented(const std::vector<std::string>& comments, std::string_view mark) {
  std::string out;
  for (const std::string& line : comments) out += fmt::format("{}{}\n", mark, line);
  return out;
}

std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& values) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find("{{", at);
    out += text.substr(at, open - at);
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find("}}", open);
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto found = std::find_if(values.begin(), values.end(), [&](const auto& entry) { return entry.first == name; });
    if (close == std::string_view::npos || found == values.end())
      throw Error(ErrorKind::internal, {"template of a target", std::string(name), "a value of that name"});
    out += found->second;
    at = close + 2;
  }
  return out;
}

}  // namespace gonio::tabulated::targets
