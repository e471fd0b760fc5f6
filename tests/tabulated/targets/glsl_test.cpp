// SPDX-License-Identifier: BSD-3-Clause
// The GLSL that is exported, run: a C++ compiler translates it in double precision.
#include <dlfcn.h>

#include <cstdlib>

#include "tests/random_directions.hpp"
#include "tests/tabulated/targets/exported.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

using Shader = void (*)(const double* light, const double* viewer, double* f);

/// The function of exported shaders, compiled together: text of each inside its own namespace.
class Shaders {
 public:
  explicit Shaders(const std::vector<std::string>& bodies, const std::string& function) {
    std::string source = "#include \"" GONIO_SOURCE "/tests/tabulated/targets/glsl_in_cpp.hpp\"\n";
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const std::string n = std::to_string(k);
      source += "namespace shader_" + n + " {\n" + bodies[k] + "}\nextern \"C\" void shader" + n +
                "(const double* l, const double* v, double* f) {\n  const vec3 r = shader_" + n + "::" + function +
                "(vec3(l[0], l[1], l[2]), vec3(v[0], v[1], v[2]), vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 1, 0));\n"
                "  for (int k = 0; k < 3; ++k) f[k] = r[k];\n}\n";
    }
    const auto file = folder_.file("shaders.cpp", source), library = folder_ / "shaders.so";
    const std::string command =
        std::string(GONIO_COMPILER) + " -std=c++17 -w -O1 -fPIC -shared -o '" + library.string() + "' '" + file.string() + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    library_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    REQUIRE(library_ != nullptr);
  }
  ~Shaders() { dlclose(library_); }
  Shaders(const Shaders&) = delete;
  Shaders& operator=(const Shaders&) = delete;

  Shader operator[](std::size_t k) const {
    Shader out = reinterpret_cast<Shader>(dlsym(library_, ("shader" + std::to_string(k)).c_str()));
    REQUIRE(out != nullptr);
    return out;
  }

 private:
  test::TemporaryFolder folder_;
  void* library_ = nullptr;
};

/// Rounding of two ways to compute the same, magnified by narrow lobes.
constexpr double same_function = 1e-9;

void check_same(Shader shader, const EvaluateFormula& formula) {
  test::Random random(test::seed);
  for (int k = 0; k < 300; ++k) {
    const Direction wi = test::upper_direction(random), wo = test::upper_direction(random);
    const double l[3] = {wi.x(), wi.y(), wi.z()}, v[3] = {wo.x(), wo.y(), wo.z()};
    double got[3], wanted[3];
    shader(l, v, got);
    formula(wi, wo, wanted);
    INFO("seed " << test::seed << ", pair " << k);
    for (int c = 0; c < 3; ++c) CHECK(got[c] == Approx(wanted[c]).epsilon(same_function).margin(1e-300));
    const double below[3] = {v[0], v[1], -v[2]};
    shader(l, below, got);
    CHECK(got[0] == 0);
  }
}

/// A .brdf file's parameters as constants, then its shader.
std::string disney_body(const std::string& text) {
  const std::size_t begin = text.find("::begin parameters\n") + 19, end = text.find("::end parameters");
  std::string out;
  std::size_t at = begin;
  while (at < end) {
    const std::string line = text.substr(at, text.find('\n', at) - at);
    const std::string name = line.substr(line.find(' ') + 1, line.find(' ', line.find(' ') + 1) - line.find(' ') - 1);
    const std::vector<double> n = test::numbers(line.substr(line.find(name) + name.size()));
    if (line.starts_with("color"))
      out += "const vec3 " + name + " = vec3(" + test::targets::triple({n[0], n[1], n[2]}, ",") + ");\n";
    else
      out += "const float " + name + " = " + test::targets::real(n.at(2)) + ";\n";
    at += line.size() + 1;
  }
  const std::size_t shader = text.find("::begin shader") + 14;
  return out + text.substr(shader, text.find("::end shader") - shader);
}

void check_target(const std::string& name, const std::string& function, std::string (*body)(const std::string&)) {
  std::vector<std::string> bodies;
  std::vector<EvaluateFormula> formulas;
  for (const auto& form : test::target_named(name).forms)
    for (const LobeSummary& summary : test::summaries()) {
      const ChannelValues values = form.formula.starts(summary).back();
      bodies.push_back(body(form.text({values, {"a remark"}})));
      formulas.push_back(form.formula.prepare(values));
    }
  const Shaders shaders(bodies, function);
  for (std::size_t k = 0; k < formulas.size(); ++k) check_same(shaders[k], formulas[k]);
}

}  // namespace

TEST_CASE("the exported GLSL evaluates to the fitted function") {
  check_target("glsl", "brdf", [](const std::string& text) { return text; });
}

TEST_CASE("the exported Disney .brdf evaluates to the fitted function") { check_target("disney", "BRDF", disney_body); }

TEST_CASE("a shader with another number in it is seen as another function") {
  const auto& form = test::target_named("glsl").forms.front();
  ChannelValues values = form.formula.starts(test::summaries()[0]).front();
  const Shaders shaders({form.text({values, {}})}, "brdf");
  values[1][0] += 1e-6;
  const Direction wi = Direction::spherical(30_deg, 0_deg), wo = Direction::spherical(40_deg, 100_deg);
  const double l[3] = {wi.x(), wi.y(), wi.z()}, v[3] = {wo.x(), wo.y(), wo.z()};
  double got[3], wanted[3];
  shaders[0](l, v, got);
  form.formula.prepare(values)(wi, wo, wanted);
  CHECK(got[0] == Approx(wanted[0]).epsilon(same_function));
  CHECK(got[1] != Approx(wanted[1]).epsilon(same_function));
}
