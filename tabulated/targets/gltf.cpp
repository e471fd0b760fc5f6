// SPDX-License-Identifier: BSD-3-Clause
// glTF 2.0: a sphere of a metallic-roughness material with the extensions it needs.
#include <array>
#include <cstdint>
#include <cstring>

#include "data-schemas/json.hpp"
#include "tabulated/targets/list.hpp"
#include "tabulated/targets/microfacet.hpp"
#include "tabulated/targets/starts.hpp"

namespace gonio::tabulated::targets {
namespace {

enum Slot : std::size_t { base_color, metallic, roughness, ior, specular, anisotropy };

const std::vector<FormulaParameter>& slots() {
  static const std::vector<FormulaParameter> list{{"baseColorFactor", 0, 1, true},     {"metallicFactor", 0, 1, false},
                                                  {"roughnessFactor", 0.04, 1, false}, {"ior", 1.02, 4, false},
                                                  {"specularFactor", 0, 1, false},     {"anisotropyStrength", -1, 1, false, 0}};
  return list;
}

/// Negative strengths stand for a direction across the tangent.
Widths lobe_widths(double rough, double strength) {
  const double a = rough * rough, along = a + (1 - a) * strength * strength;
  return strength < 0 ? Widths{a, along} : Widths{along, a};
}

EvaluateFormula prepare(const ChannelValues& values) {
  const std::vector<double>& s = values.front();
  return [values, alpha = lobe_widths(s[roughness], s[anisotropy]), m = s[metallic], f0 = f0_of(s[ior]), weight = s[specular]](
             const Direction& wi, const Direction& wo, double* f) {
    std::fill(f, f + values.size(), 0.0);
    if (!above(wi, wo)) return;
    const MicrofacetPair p(wi, wo);
    const double lobe = ggx_d(p, alpha.x, alpha.y) * correlated_visibility(wi, wo, alpha.x, alpha.y), w = schlick_weight(p.cos_d);
    const double fresnel = weight * (f0 + (1 - f0) * w);
    for (std::size_t c = 0; c < values.size(); ++c) {
      const double base = values[c][base_color];
      f[c] = (1 - m) * ((1 - fresnel) * base * inverse_pi + fresnel * lobe) + m * (base + (1 - base) * w) * lobe;
    }
  };
}

std::vector<double> convert(const LobeSummary& s, bool metal, std::size_t c) {
  const double narrow = std::min(s.alpha_x, s.alpha_y), wide = std::max(s.alpha_x, s.alpha_y);
  const double strength = std::sqrt(std::max(0.0, (wide - narrow) / std::max(1 - narrow, 1e-6)));
  return {metal ? s.f0[c] : s.rho_d[c],
          metal ? 1.0 : 0.0,
          std::sqrt(narrow),
          metal ? 1.5 : index_of(mean(s.f0)),
          1.0,
          s.alpha_y > s.alpha_x ? -strength : strength};
}
std::vector<ChannelValues> starts(const LobeSummary& s) { return converted_starts(s, slots(), true, convert); }

std::string base64(const std::string& bytes) {
  static constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t group = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - k);
    for (std::size_t j = 0; j < 3; ++j) group = group << 8 | (j < n ? static_cast<unsigned char>(bytes[k + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j) out += j <= n ? letters[group >> (18 - 6 * j) & 63] : '=';
  }
  return out;
}

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// A unit sphere, y up, tangents to the east.
struct Sphere {
  static constexpr int columns = 64, rows = 32;
  std::string positions, tangents, indices;
  std::int64_t vertex_count = 0, index_count = 0;

  Sphere() {
    constexpr double pi = std::numbers::pi;
    for (int r = 0; r <= rows; ++r)
      for (int c = 0; c <= columns; ++c) {
        const double theta = pi * r / rows, phi = 2 * pi * c / columns;
        const double sine = r == 0 || r == rows ? 0 : std::sin(theta);
        for (const double v : {sine * std::sin(phi), std::cos(theta), sine * std::cos(phi)}) append(positions, static_cast<float>(v));
        for (const double v : {std::cos(phi), 0.0, -std::sin(phi), 1.0}) append(tangents, static_cast<float>(v));
        ++vertex_count;
      }
    const auto corner = [](int r, int c) { return static_cast<std::uint16_t>(r * (columns + 1) + c); };
    const auto triangle = [&](std::uint16_t a, std::uint16_t b, std::uint16_t c) {
      append(indices, a), append(indices, b), append(indices, c);
      index_count += 3;
    };
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        if (r > 0) triangle(corner(r, c), corner(r + 1, c), corner(r, c + 1));
        if (r + 1 < rows) triangle(corner(r, c + 1), corner(r + 1, c), corner(r + 1, c + 1));
      }
  }
};

Json accessor(int view, int component, std::int64_t count, const char* type) {
  return Json::object({{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
}

std::string text(const Material& m) {
  Json extensions = Json::object(), used = Json::array();
  const auto extend = [&](const char* name, Json values) {
    extensions.set(name, std::move(values));
    used.push_back(name);
  };
  extend("KHR_materials_ior", Json::object({{"ior", m.shared(ior)}}));
  extend("KHR_materials_specular", Json::object({{"specularFactor", m.shared(specular)}}));
  if (const double strength = m.shared(anisotropy); strength != 0)
    extend("KHR_materials_anisotropy",
           Json::object({{"anisotropyStrength", std::abs(strength)}, {"anisotropyRotation", strength < 0 ? std::numbers::pi / 2 : 0.0}}));
  const auto colour = m.colour(base_color);
  Json remarks = Json::array();
  for (const std::string& line : m.comments) remarks.push_back(line);

  constexpr int floats = 5126, shorts = 5123, array_buffer = 34962, element_buffer = 34963;
  const Sphere sphere;
  const auto size = [](const std::string& bytes) { return static_cast<std::int64_t>(bytes.size()); };
  const auto view = [&](std::int64_t at, const std::string& bytes, int target) {
    return Json::object({{"buffer", 0}, {"byteOffset", at}, {"byteLength", size(bytes)}, {"target", target}});
  };
  const auto list = [](Json only) { return Json(Json::Array{std::move(only)}); };
  const std::int64_t after = size(sphere.positions), last = after + size(sphere.indices);
  Json positions = accessor(0, floats, sphere.vertex_count, "VEC3");
  positions.set("min", Json(Json::Array{-1.0, -1.0, -1.0}));
  positions.set("max", Json(Json::Array{1.0, 1.0, 1.0}));
  Json accessors(Json::Array{positions, accessor(1, shorts, sphere.index_count, "SCALAR")});
  Json views(Json::Array{view(0, sphere.positions, array_buffer), view(after, sphere.indices, element_buffer)});
  // On the unit sphere the normal is the position.
  Json attributes = Json::object({{"POSITION", 0}, {"NORMAL", 0}});
  std::string bytes = sphere.positions + sphere.indices;
  bytes.resize(static_cast<std::size_t>(last));
  if (m.shared(anisotropy) != 0) {
    accessors.push_back(accessor(2, floats, sphere.vertex_count, "VEC4"));
    views.push_back(view(last, sphere.tangents, array_buffer));
    attributes.set("TANGENT", 2);
    bytes += sphere.tangents;
  }

  Json document;
  document.set("asset", Json::object({{"version", "2.0"}, {"generator", "gonio"}, {"extras", Json::object({{"remarks", remarks}})}}));
  document.set("extensionsUsed", used);
  document.set("scene", 0);
  document.set("scenes", list(Json::object({{"nodes", list(0)}})));
  document.set("nodes", list(Json::object({{"mesh", 0}, {"name", "sphere"}})));
  const Json primitive = Json::object({{"attributes", attributes}, {"indices", 1}, {"material", 0}});
  document.set("meshes", list(Json::object({{"primitives", list(primitive)}})));
  const Json metallic_roughness = Json::object({{"baseColorFactor", Json(Json::Array{colour[0], colour[1], colour[2], 1.0})},
                                                {"metallicFactor", m.shared(metallic)},
                                                {"roughnessFactor", m.shared(roughness)}});
  document.set("materials",
               list(Json::object({{"name", "gonio material"}, {"pbrMetallicRoughness", metallic_roughness}, {"extensions", extensions}})));
  document.set("accessors", accessors);
  document.set("bufferViews", views);
  document.set("buffers",
               list(Json::object({{"byteLength", size(bytes)}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}})));
  return document.dump() + "\n";
}

}  // namespace

RenderTarget gltf_target() {
  return {"gltf",
          "glTF 2.0 sphere of a metallic-roughness material",
          ".gltf",
          {{{"metallic-roughness",
             "Khronos glTF 2.0 specification, appendix B; KHR_materials_ior, _specular and _anisotropy",
             "alpha = roughnessFactor²; along the tangent alpha + (1 - alpha) anisotropyStrength²",
             "Smith, correlated through the height",
             "Schlick to 1 from the index, or from the base colour of a metal; what it reflects is taken from the diffuse part",
             slots(),
             prepare,
             starts,
             {"one base colour is both the diffuse colour and the metal's reflectance; a dielectric's lobe has no colour"}},
            text}},
          {"the formula is the one the specification gives as an example: viewers may approximate it"}};
}

}  // namespace gonio::tabulated::targets
