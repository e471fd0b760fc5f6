// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/sphere_scene.hpp"

#include <fmt/format.h>

#include <string>

#include "data-schemas/write_file.hpp"
#include "tabulated/formats/radiance_xml.hpp"

namespace gonio::tabulated {
namespace {

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  return out;
}

std::string pbrt_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  return out;
}

std::string mitsuba_scene(const std::string& file, bool spectral) {
  return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<!-- mitsuba -m {0} FILE.xml -->
<scene version="3.0.0">
  <integrator type="path"/>
  <sensor type="perspective">
    <float name="fov" value="28"/>
    <transform name="to_world">
      <lookat origin="0, -5, 0" target="0, 0, 0" up="0, 0, 1"/>
    </transform>
    <film type="hdrfilm">
      <integer name="width" value="512"/>
      <integer name="height" value="512"/>
    </film>
    <sampler type="independent">
      <integer name="sample_count" value="64"/>
    </sampler>
  </sensor>
  <emitter type="directional">
    <vector name="direction" x="1" y="2" z="-2"/>
    <rgb name="irradiance" value="3, 3, 3"/>
  </emitter>
  <emitter type="constant">
    <rgb name="radiance" value="0.2, 0.2, 0.2"/>
  </emitter>
  <shape type="sphere">
    <bsdf type="measured">
      <string name="filename" value="{1}"/>
    </bsdf>
  </shape>
</scene>
)",
                     spectral ? "scalar_spectral" : "scalar_rgb", xml_escaped(file));
}

std::string pbrt_scene(const std::string& file, const std::string& image) {
  return fmt::format(R"(# pbrt FILE.pbrt
LookAt 0 -5 0  0 0 0  0 0 1
Camera "perspective" "float fov" 28
Sampler "zsobol" "integer pixelsamples" 64
Integrator "path"
Film "rgb" "integer xresolution" 512 "integer yresolution" 512 "string filename" "{1}"
WorldBegin
LightSource "distant" "point3 from" [ -1 -2 2 ] "point3 to" [ 0 0 0 ] "rgb L" [ 3 3 3 ]
LightSource "infinite" "rgb L" [ 0.2 0.2 0.2 ]
Material "measured" "string filename" "{0}"
Shape "sphere" "float radius" 1
)",
                     pbrt_escaped(file), pbrt_escaped(image));
}

}  // namespace

std::vector<std::filesystem::path> write_sphere_scenes(std::string_view format, const std::filesystem::path& material) {
  std::vector<std::filesystem::path> out;
  const auto write = [&](const char* extension, const std::string& text) {
    std::filesystem::path path = material;
    write_file_atomically(path.replace_extension(extension), text);
    out.push_back(std::move(path));
  };
  const std::string file = material.filename().string();
  if (format == "rgl") write(".xml", mitsuba_scene(file, false));
  if (format == "rgl-spectral") {
    write(".xml", mitsuba_scene(file, true));
    write(".pbrt", pbrt_scene(file, material.stem().string() + ".exr"));
  }
  if (format.starts_with("radiance-")) write(".rad", radiance_scene(file));
  return out;
}

}  // namespace gonio::tabulated
