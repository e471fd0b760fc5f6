// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/rgl.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "tests/shared_data.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/tensor_writer.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

using Fields = std::vector<test::TensorField>;

test::TensorField& field(Fields& fields, const std::string& name) {
  return *std::find_if(fields.begin(), fields.end(), [&](const test::TensorField& f) { return f.name == name; });
}

std::string faults_in(const Fields& fields) {
  const test::TemporaryFolder folder;
  const auto path = folder.file("m.bsdf", test::tensor_file(fields));
  return test::faults_of([&] { open_brdf(path); });
}

void set_number(test::TensorField& field, std::size_t k, float value) { std::memcpy(field.bytes.data() + 4 * k, &value, sizeof value); }

}  // namespace

TEST_CASE("A material file is known by its content and offers a table and its nodes") {
  const test::TemporaryFolder folder;
  const Opened opened = open_brdf(folder.file("any.name", test::tensor_file(test::RglMaterial{}.fields())));
  CHECK(opened.format == "rgl");
  REQUIRE(opened.brdf);
  REQUIRE(opened.observations);
  CHECK(opened.brdf->channels() == rgb_channels());
  CHECK(opened.observations->block_count() == 1);
  CHECK(opened.observations->block(0).size > 6);
  CHECK_FALSE(opened.dataset);
}

TEST_CASE("A spectral file has one channel per wavelength") {
  const test::TemporaryFolder folder;
  const test::RglMaterial material{.wavelengths = {360, 550.5f, 1000},
                                   .value = [](std::size_t, std::size_t c, double, double) { return 1.0 + double(c); }};
  const Opened opened = open_brdf(folder.file("m.bsdf", test::tensor_file(material.fields())));
  const Channels& channels = opened.brdf->channels();
  REQUIRE(channels.size() == 3);
  CHECK(channels[1].name == "550.5nm");
  CHECK(channels[1].wavelength_in_nm == 550.5);
  const auto f = opened.brdf->eval(Direction::spherical(20_deg, 0_deg), Direction{});
  CHECK(std::fabs(f[2] / f[0] - 3) < 1e-6);
}

TEST_CASE("Every fault of a material file is named at once") {
  Fields fields = test::RglMaterial{}.fields();
  std::erase_if(fields, [](const auto& f) { return f.name == "luminance" || f.name == "description"; });
  field(fields, "jacobian").bytes = std::string(1, '\0');
  set_number(field(fields, "theta_i"), 2, 0.25f);
  set_number(field(fields, "sigma"), 1, 0);
  set_number(field(fields, "ndf"), 3, std::numeric_limits<float>::quiet_NaN());
  set_number(field(fields, "vndf"), 5, -1);
  set_number(field(fields, "rgb"), 7, std::numeric_limits<float>::infinity());
  const std::string faults = faults_in(fields);
  for (const char* word : {"no field 'luminance'", "no field 'description'", "'jacobian'", "'theta_i' element 2", "'sigma' element 1",
                           "'ndf' element 3", "'vndf' element 5", "'rgb' element 7"}) {
    INFO(word << " in\n" << faults);
    CHECK(faults.find(word) != std::string::npos);
  }
}

TEST_CASE("Fields that do not fit together are refused") {
  const auto faults_with = [](auto&& change) {
    Fields fields = test::RglMaterial{}.fields();
    change(fields);
    return faults_in(fields);
  };
  const auto has = [](const std::string& faults, const char* word) {
    INFO(word << " in\n" << faults);
    CHECK(faults.find(word) != std::string::npos);
  };
  has(faults_with([](Fields& f) { field(f, "rgb").shape = {1, 3, 1, 3, 9}; }), "red, green and blue");
  has(faults_with([](Fields& f) { field(f, "vndf").shape = {3, 1, 3, 3}; }), "one slice per phi_i and theta_i");
  has(faults_with([](Fields& f) { field(f, "vndf").shape = {1, 3, 9, 1}; }), "at least 2 x 2");
  has(faults_with([](Fields& f) { field(f, "sigma").shape = {4, 1}; }), "the grid of 'ndf'");
  has(faults_with([](Fields& f) { field(f, "ndf").type = 5; }), "u32 of shape [2, 2]");
  has(faults_with([](Fields& f) { field(f, "theta_i").shape = {0}; }), "f32 of shape [0]");
  has(faults_with([](Fields& f) {
        for (std::size_t k = 0; k < 9; ++k) set_number(field(f, "vndf"), k, 0);
      }),
      "slice 0");
  has(faults_with([](Fields& f) { f.push_back(test::floats("wavelengths", {2}, {500, 400})); }), "no field 'spectra'");
  Fields turned = test::RglMaterial{.phi_i = {0, 0.3f, 0.8f}}.fields();
  has(faults_in(turned), "a whole, a half or a quarter turn");
  CHECK(faults_with([](Fields&) {}).empty());
}

TEST_CASE("No damaged material file does more than raise an error") {
  const test::TemporaryFolder scratch;
  std::mt19937 random(20260704);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::string seed = test::tensor_file(test::RglMaterial{.wavelengths = {400, 500}}.fields());
  const std::size_t table_of_fields = seed.find("a test");
  int read = 0, refused = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string file = seed;
    for (std::size_t edit = 0, edits = 1 + below(3); edit < edits && !file.empty(); ++edit) {
      const std::size_t at = below(random() % 2 == 0 ? std::min(table_of_fields, file.size()) : file.size());
      switch (below(5)) {
        case 0: file[at] = static_cast<char>(random()); break;
        case 1: file[at] = static_cast<char>(file[at] ^ (1 << below(8))); break;
        case 2: file.erase(at, 1 + below(8)); break;
        case 3: file.resize(at); break;
        default: file.insert(at, file.substr(below(file.size()), below(30))); break;
      }
    }
    INFO("round " << round << " of seed 20260704");
    try {
      ReadOptions options;
      options.format = "rgl";
      const Opened opened = open_brdf(scratch.file("damaged.bsdf", file), options);
      const auto f = opened.brdf->eval(Direction::spherical(30_deg, 40_deg), Direction::spherical(50_deg, 200_deg));
      REQUIRE(f.size() == opened.brdf->channels().size());
      opened.observations->block_count();
      ++read;
    } catch (const Error& error) {
      REQUIRE(error.kind() == ErrorKind::input);
      ++refused;
    }
  }
  CHECK(read > 200);
  CHECK(refused > 500);
}

TEST_CASE("Measured materials evaluate as Mitsuba 3.9.1 does, over cos theta_o") {
  struct Reference {
    const char* name;
    double theta_i, phi_i, theta_o, phi_o;
    double r, g, b;
  };
  const Reference references[] = {
      {"aurora_white", 20, 0, 35, 170, 0.24993621, 0.39309815, 0.3080787},
      {"aurora_white", 45, 30, 47, 208, 1.808257, 3.7328322, 2.7671068},
      {"aurora_white", 70, -60, 15, 90, 0.18148305, 0.15519724, 0.1720722},
      {"cc_ibiza_sunset", 20, 0, 35, 170, 0.28795651, 0.09161157, 0.10390558},
      {"cc_ibiza_sunset", 45, 30, 47, 208, 3.3612944, 1.8013677, 1.3237091},
      {"cc_ibiza_sunset", 70, -60, 15, 90, 0.015716939, 0.0066051041, 0.0026229721},
      {"cm_military_green", 20, 0, 35, 170, 0.065807186, 0.073321966, 0.066606446},
      {"cm_military_green", 45, 30, 47, 208, 0.62139455, 0.61933395, 0.59599243},
      {"cm_military_green", 70, -60, 15, 90, 0.0089208695, 0.015132509, 0.0065364794},
      {"irid_flake_paint1", 20, 0, 35, 170, 0.040821885, 0.034552062, 0.029024732},
      {"irid_flake_paint1", 45, 30, 47, 208, 2.7867518, 2.7507938, 2.7493673},
      {"irid_flake_paint1", 70, -60, 15, 90, 0.0046748434, 0.018649398, 0.018505854},
      {"vch_silk_blue", 20, 0, 35, 170, 0.020833907, 0.089214366, 0.33682485},
      {"vch_silk_blue", 45, 30, 47, 208, -0.1764609, 0.89925071, 4.0716066},
      {"vch_silk_blue", 70, -60, 15, 90, 0.0071266747, 0.0035501154, 0.021265094},
  };
  // Mitsuba evaluates in float.
  constexpr double single_precision = 2e-5;
  SUCCEED();
  for (const Reference& ref : references) {
    const auto path = test::measured_data(std::string("rgl/") + ref.name + "_rgb.bsdf");
    if (!path) continue;
    const Opened opened = open_brdf(*path);
    const auto f = opened.brdf->eval(Direction::spherical(degrees(ref.theta_i), degrees(ref.phi_i)),
                                     Direction::spherical(degrees(ref.theta_o), degrees(ref.phi_o)));
    INFO(ref.name << " at " << ref.theta_i << " " << ref.phi_i << " " << ref.theta_o << " " << ref.phi_o);
    CHECK(std::fabs(f[0] - ref.r) < single_precision * std::fabs(ref.r));
    CHECK(std::fabs(f[1] - ref.g) < single_precision * std::fabs(ref.g));
    CHECK(std::fabs(f[2] - ref.b) < single_precision * std::fabs(ref.b));
    std::size_t samples = 0;
    for (std::size_t b = 0; b < opened.observations->block_count(); ++b) samples += opened.observations->block(b).size;
    CHECK(samples > 6000);
  }
}
