// SPDX-License-Identifier: BSD-3-Clause
// The numbers of every exported text, read back, make the fitted function. (GLSL and .brdf are run: glsl_test.cpp.)
#include <cmath>
#include <functional>

#include "data-schemas/json.hpp"
#include "tests/random_directions.hpp"
#include "tests/tabulated/targets/exported.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

using Column = std::vector<double>;
/// From a text to values in the order of its formula.
using Reader = std::function<ChannelValues(const std::string&)>;

/// Mean width and aspect from the widths along x and y.
std::vector<Column> widths_of(double x, double y) { return {{std::sqrt(x * y)}, {std::sqrt(y / x)}}; }

constexpr double same_function = 1e-9;  // rounding of square roots and their squares

/// Every start of every form of a target goes out and comes back.
void check_read_back(const std::string& name, const std::vector<Reader>& readers) {
  const auto& target = test::target_named(name);
  REQUIRE(target.forms.size() == readers.size());
  test::Random random(test::seed);
  for (std::size_t k = 0; k < readers.size(); ++k)
    for (const LobeSummary& summary : test::summaries())
      for (const ChannelValues& values : target.forms[k].formula.starts(summary)) {
        const std::string text = target.forms[k].text({values, {"a remark"}});
        const EvaluateFormula wanted = target.forms[k].formula.prepare(values), got = target.forms[k].formula.prepare(readers[k](text));
        INFO(name << ", " << target.forms[k].formula.name << ", seed " << test::seed << "\n" << text.substr(0, 2000));
        for (int n = 0; n < 20; ++n) {
          const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
          double a[3], b[3];
          got(wi, wo, a);
          wanted(wi, wo, b);
          for (int c = 0; c < 3; ++c) CHECK(a[c] == Approx(b[c]).epsilon(same_function).margin(1e-300));
        }
      }
}

/// `name="X" value="1, 2, 3"` of Mitsuba, and of MaterialX with a type between.
Column xml(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("name=\"" + name + "\"");
  REQUIRE(at != std::string::npos);
  return test::after(text.substr(at), "value=\"", "\"");
}

/// `"float X" [ 1 ]`
Column pbrt(const std::string& text, const std::string& name) { return test::after(text, name + "\" [", "]"); }

/// Strings and numbers of a Radiance primitive, by words.
std::vector<std::string> words_after(const std::string& text, const std::string& start) {
  std::istringstream rest(text.substr(text.find(start) + start.size()));
  std::vector<std::string> out;
  for (std::string word; rest >> word;) out.push_back(word);
  return out;
}

double number(const std::string& word) { return std::stod(word); }

ChannelValues radiance_wgmd(const std::string& text) {
  const auto lobe = words_after(text, "void colorfunc material_lobe\n4 "), rest = words_after(text, "void WGMDfunc material\n");
  // 13 material_lobe 1 ux uy | void 0 0 0 | void 1 0 0 . | 0 | 9 r g b …
  REQUIRE(rest[1] == "material_lobe");
  REQUIRE(rest[14] == "0");
  REQUIRE(rest[15] == "9");
  const auto widths = widths_of(number(rest[3]), number(rest[4]));
  return test::rows(
      {{number(rest[16]), number(rest[17]), number(rest[18])}, {number(lobe[0]), number(lobe[1]), number(lobe[2])}, widths[0], widths[1]});
}

ChannelValues radiance_simple(const std::string& text) {
  const bool anisotropic = text.find("2 material\n") != std::string::npos;
  const auto words = words_after(text, " material\n");
  const std::size_t at = anisotropic ? 6 : 2;  // after the strings and the zero integers: the count of numbers
  REQUIRE(words[at] == (anisotropic ? "6" : "5"));
  const double x = number(words[at + 5]), y = anisotropic ? number(words[at + 6]) : x;
  const auto widths = widths_of(x, y);
  return test::rows({{number(words[at + 1]), number(words[at + 2]), number(words[at + 3])}, {number(words[at + 4])}, widths[0], widths[1]});
}

/// `"X": value,` of the Python program, a colour without its alpha.
Column blender(const std::string& text, const std::string& name) {
  Column out = test::after(text, "\"" + name + "\": ", ",\n");
  if (out.size() == 4) out.pop_back();
  return out;
}

/// `X = value` or `X = color(...)` of a shader's parameters.
Column osl(const std::string& text, const std::string& name) { return test::after(text, " " + name + " = ", "\n"); }

Column signed_amount(const Column& amount, bool turned) { return {turned ? -amount.at(0) : amount.at(0)}; }

}  // namespace

TEST_CASE("an exported Mitsuba scene reads back as the fitted function") {
  check_read_back(
      "mitsuba",
      {[](const std::string& t) {
         const auto w = widths_of(xml(t, "alpha_u")[0], xml(t, "alpha_v")[0]);
         return test::rows({xml(t, "reflectance"), xml(t, "eta"), xml(t, "k"), w[0], w[1], xml(t, "weight")});
       },
       [](const std::string& t) {
         return test::rows({xml(t, "diffuse_reflectance"), xml(t, "alpha"), xml(t, "int_ior"), xml(t, "specular_reflectance")});
       },
       [](const std::string& t) {
         return test::rows({xml(t, "base_color"), xml(t, "roughness"), xml(t, "metallic"), xml(t, "eta"), xml(t, "anisotropic")});
       }});
}

TEST_CASE("an exported pbrt scene reads back as the fitted function, without remapped roughness") {
  check_read_back("pbrt",
                  {[](const std::string& t) {
                     CHECK(t.find("\"bool remaproughness\" false") != std::string::npos);
                     const auto w = widths_of(pbrt(t, "uroughness")[0], pbrt(t, "vroughness")[0]);
                     return test::rows({pbrt(t, "reflectance"), pbrt(t, "rgb eta"), pbrt(t, "rgb k"), w[0], w[1], pbrt(t, "amount")});
                   },
                   [](const std::string& t) {
                     CHECK(t.find("\"bool remaproughness\" false") != std::string::npos);
                     return test::rows({pbrt(t, "reflectance"), pbrt(t, "float roughness"), pbrt(t, "float eta")});
                   }});
}

TEST_CASE("exported MaterialX documents read back as the fitted function") {
  check_read_back(
      "materialx-standard-surface", {[](const std::string& t) {
        return test::rows({xml(t, "base_color"), xml(t, "specular_color"), xml(t, "metalness"), xml(t, "specular_roughness"),
                           xml(t, "specular_IOR"), signed_amount(xml(t, "specular_anisotropy"), xml(t, "specular_rotation")[0] == 0.25)});
      }});
  check_read_back("openpbr", {[](const std::string& t) {
                    return test::rows({xml(t, "base_color"), xml(t, "specular_color"), xml(t, "base_metalness"),
                                       xml(t, "specular_roughness"), xml(t, "specular_ior"), xml(t, "specular_roughness_anisotropy")});
                  }});
}

TEST_CASE("an exported glTF reads back as the fitted function, with a mesh of the size it says") {
  check_read_back("gltf", {[](const std::string& t) {
                    const Json document = parse_json(t, "gltf"), &material = document.at("materials")[0];
                    const Json &base = material.at("pbrMetallicRoughness"), &extensions = material.at("extensions");
                    Column colour;
                    for (std::size_t c = 0; c < 3; ++c) colour.push_back(base.at("baseColorFactor")[c].number());
                    double strength = 0;
                    if (const Json& anisotropy = extensions.get("KHR_materials_anisotropy"); !anisotropy.is_null())
                      strength = anisotropy.at("anisotropyStrength").number() * (anisotropy.at("anisotropyRotation").number() > 1 ? -1 : 1);
                    const std::string uri = document.at("buffers")[0].at("uri").string();
                    const auto bytes = document.at("buffers")[0].at("byteLength").integer();
                    const std::size_t letters = uri.size() - (uri.find(',') + 1);
                    CHECK(letters == static_cast<std::size_t>((bytes + 2) / 3 * 4));
                    return test::rows({colour,
                                       {base.at("metallicFactor").number()},
                                       {base.at("roughnessFactor").number()},
                                       {extensions.at("KHR_materials_ior").at("ior").number()},
                                       {extensions.at("KHR_materials_specular").at("specularFactor").number()},
                                       {strength}});
                  }});
}

TEST_CASE("an exported Blender program reads back as the fitted function") {
  check_read_back("blender", {[](const std::string& t) {
                    return test::rows({blender(t, "Base Color"), blender(t, "Metallic"), blender(t, "Specular"), blender(t, "Roughness"),
                                       signed_amount(blender(t, "Anisotropic"), blender(t, "Anisotropic Rotation")[0] == 0.25)});
                  }});
}

TEST_CASE("an exported OSL shader reads back as the fitted function") {
  check_read_back("osl", {[](const std::string& t) {
                    const auto w = widths_of(osl(t, "roughness_x")[0], osl(t, "roughness_y")[0]);
                    return test::rows({osl(t, "albedo"), osl(t, "f0"), osl(t, "f90"), w[0], w[1]});
                  }});
}

TEST_CASE("exported Radiance materials read back as the fitted function") {
  check_read_back("radiance", {radiance_wgmd});
  check_read_back("radiance-plastic", {radiance_simple, radiance_simple});
}
