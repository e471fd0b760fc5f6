// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/sphere_scene.hpp"

#include <fmt/format.h>

#include <string>

#include "data-schemas/write_file.hpp"
#include "tabulated/targets/sphere.hpp"

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
  return targets::mitsuba_sphere(fmt::format("  mitsuba -m {} FILE.xml\n", spectral ? "scalar_spectral" : "scalar_rgb"),
                                 fmt::format("    <bsdf type=\"measured\" id=\"material\">\n"
                                             "        <string name=\"filename\" value=\"{}\"/>\n"
                                             "    </bsdf>\n",
                                             xml_escaped(file)));
}

std::string pbrt_scene(const std::string& file, const std::string& image) {
  return targets::pbrt_sphere(
      "# pbrt FILE.pbrt\n",
      fmt::format("MakeNamedMaterial \"material\" \"string type\" \"measured\" \"string filename\" \"{}\"\n", pbrt_escaped(file)),
      pbrt_escaped(image));
}

std::string radiance_scene(const std::string& file) {
  const bool one_word = file.find(' ') == std::string::npos;
  return targets::radiance_sphere("# Up is z: where the azimuth 0 of the BSDF matters, the surface is turned so that its y looks up.\n",
                                  fmt::format("void BSDF material\n6 0 {0}{1}{0} 0 0 1 .\n0\n0\n", one_word ? "" : "\"", file));
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
