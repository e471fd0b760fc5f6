// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "tests/command.hpp"
#include "tests/shared_data.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

double parameter(const Json& document, const std::string& name) {
  for (const Json& p : document.at("parameters").elements())
    if (p.at("name").string() == name) return p.at("value").number();
  return NAN;
}

}  // namespace

TEST_CASE("fit gives the published parameters of the vegetation data for every metric") {
  const auto path = test::measured_data("lumos/vegetation_brdf_cars.csv");
  if (!path) return;
  struct Row {
    const char* metric;
    double rho_d, rho_s, s;
  };
  // log: published with the data (ρd .53 ρs .28 s 7.31) and refitted independently; the others refitted independently.
  const Row rows[] = {{"log", .5340, .2840, 7.314},
                      {"linear", .6249, .3513, 6.328},
                      {"linear-cos", .6304, .2020, 8.225},
                      {"cbrt", .5630, .3032, 7.032},
                      {"log1p", .6165, .2113, 8.191}};
  constexpr double last_digit = 1e-3;
  for (const Row& row : rows) {
    const auto outcome =
        run_gonio("fit '" + path->string() +
                  "' --columns theta_i_deg=1,phi_i_deg=2,theta_o_deg=3,phi_o_deg=4,value=5 --model phong --json --metric " + row.metric);
    INFO(row.metric << ": " << outcome.err);
    REQUIRE(outcome.code == 0);
    const Json document = outcome.json();
    CHECK(faults_of(document, Schema::fit, "fit").empty());
    CHECK(parameter(document, "rho_d") == Approx(row.rho_d).margin(last_digit));
    CHECK(parameter(document, "rho_s") == Approx(row.rho_s).margin(last_digit));
    CHECK(parameter(document, "s") == Approx(row.s).margin(last_digit));
    CHECK(document.at("n_observations").integer() > 14000);
  }
}

TEST_CASE("fit says when nothing can be fitted, and exits 1 only if it did not converge") {
  const test::TemporaryFolder folder;
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n";
  for (int theta = 0; theta < 80; theta += 5) text += "30,0," + std::to_string(theta) + ",180,0.1,0.001\n";
  test::write_file(folder / "flat.csv", text);
  // No lobe in the data: s is unidentified, and that is an answer.
  const auto flat = run_gonio("fit '" + (folder / "flat.csv").string() + "' --model blinn-phong --json");
  INFO(flat.err);
  REQUIRE(flat.code == 0);
  const Json document = flat.json();
  for (const Json& p : document.at("parameters").elements())
    if (p.at("name").string() == "s") {
      CHECK(p.at("kind").string() == "unidentified");
      CHECK(p.at("sigma").is_null());
      CHECK(p.at("interval").is_null());
    }
  // Negative values only, fitted in the logarithm: nothing is usable.
  test::write_file(folder / "negative.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n30,0,30,180,-0.1\n30,0,40,180,-0.2\n");
  const auto negative = run_gonio("fit '" + (folder / "negative.csv").string() + "' --model phong --metric log --json");
  CHECK(negative.code == 1);
  CHECK(negative.json().at("status").string() == "no_usable_data");
}

TEST_CASE("fit --out writes the document that open and eval read as a model") {
  const test::TemporaryFolder folder;
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n";
  const std::string lambert = "0.1";
  for (int theta = 0; theta < 80; theta += 5) text += "30,0," + std::to_string(theta) + ",180," + lambert + "\n";
  test::write_file(folder / "flat.csv", text);
  REQUIRE(run_gonio("fit '" + (folder / "flat.csv").string() + "' --model lambert --out '" + (folder / "fit.json").string() + "'").code ==
          0);
  const auto value = run_gonio("eval '" + (folder / "fit.json").string() + "'", "10 0 20 90\n");
  CHECK(std::stod(value.out) == Approx(0.1).epsilon(1e-12));
}

TEST_CASE("fit says of its intervals the confidence that was asked for") {
  const test::TemporaryFolder folder;
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n";
  for (int theta = 0; theta < 80; theta += 2)
    text += "30,0," + std::to_string(theta) + ",180," + std::to_string(.1 + std::exp(-.01 * (theta - 30) * (theta - 30))) + ",0.01\n";
  test::write_file(folder / "lobe.csv", text);
  const std::string fit = "fit '" + (folder / "lobe.csv").string() + "' --model blinn-phong --metric linear ";
  const auto width = [](const Json& document) {
    const Json& ends = document.at("parameters").elements().back().at("interval");
    return ends.elements()[1].number() - ends.elements()[0].number();
  };
  const auto wide = run_gonio(fit + "--json"), narrow = run_gonio(fit + "--confidence 0.683 --json");
  REQUIRE(wide.code == 0);
  REQUIRE(narrow.code == 0);
  CHECK(faults_of(narrow.json(), Schema::fit, "fit").empty());
  CHECK(wide.json().at("confidence").number() == .95);
  CHECK(narrow.json().at("confidence").number() == .683);
  CHECK(width(wide.json()) / width(narrow.json()) == Approx(1.96).epsilon(.05));
  const std::string lines = run_gonio(fit + "--confidence 0.683").out;
  CHECK(lines.find("68.3 %") != lines.npos);
  CHECK(lines.find("95") == lines.npos);
}

TEST_CASE("a row of NaN and a row below the horizon are masked and reported, and change nothing else") {
  const test::TemporaryFolder folder;
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,r,g\n";
  for (int theta = 0; theta < 80; theta += 2) {
    const std::string f = std::to_string(.1 + std::exp(-.01 * (theta - 30) * (theta - 30)));
    text += "30,0," + std::to_string(theta) + ",180," + f + "," + f + "\n";
  }
  test::write_file(folder / "clean.csv", text);
  const std::string masked_rows = text + "30,0,30,180,nan,nan\n30,0,100,180,0.1,0.1\n30,0,20,180,-1,-1\n";
  test::write_file(folder / "masked.csv", masked_rows);
  test::write_file(folder / "flawed.csv", masked_rows + "30,0,40,180,nan,0.47\n");
  const auto fit = [&](const char* file, const char* flags) {
    return run_gonio("fit '" + (folder / file).string() + "' --model blinn-phong --metric linear " + flags);
  };
  const auto clean = fit("clean.csv", "--json"), flawed = fit("flawed.csv", "--json");
  INFO(flawed.err);
  REQUIRE(flawed.code == 0);
  const Json document = flawed.json(), masked = document.at("n_masked");
  CHECK(faults_of(document, Schema::fit, "fit").empty());
  CHECK(masked.at("nan").integer() == 1);
  CHECK(masked.at("below_horizon").integer() == 1);
  CHECK(masked.at("missing").integer() == 1);
  CHECK(masked.at("not_fitted").integer() == 1);
  CHECK(masked.at("not_fitted_by_reason").at("no_value").integer() == 1);
  CHECK(document.at("n_observations").integer() == clean.json().at("n_observations").integer() + 1);
  const Json same = fit("masked.csv", "--json").json();
  for (const char* name : {"rho_d", "rho_s", "s"}) CHECK(parameter(same, name) == parameter(clean.json(), name));
  CHECK(fit("masked.csv", "").out.find("masked: 1 NaN, 1 marked as missing, 1 below the horizon\n") != std::string::npos);
  CHECK(fit("flawed.csv", "").out.find("masked: 2 NaN, 1 marked as missing, 1 below the horizon\n") != std::string::npos);
  CHECK(fit("clean.csv", "").out.find("masked") == std::string::npos);
}

TEST_CASE("fit tells where the model misses the data, in the document, the text and a picture") {
  const test::TemporaryFolder folder;
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n";
  for (int theta_i = 0; theta_i < 80; theta_i += 10)
    for (int theta_o = 0; theta_o < 80; theta_o += 2)
      for (int phi = 0; phi < 360; phi += 30)
        text += std::to_string(theta_i) + ",0," + std::to_string(theta_o) + "," + std::to_string(phi) + "," +
                (theta_i == 60 && theta_o > 60 && phi >= 90 && phi <= 270 ? "0.2" : "0.1") + ",0.002\n";
  test::write_file(folder / "forward.csv", text);
  const std::string fit = "fit '" + (folder / "forward.csv").string() + "' --model lambert --metric linear ",
                    png = (folder / "map.png").string();
  const Json document = run_gonio(fit + "--json").json();
  CHECK(faults_of(document, Schema::fit, "fit").empty());
  const Json& map = document.at("residual_map");
  CHECK(map.at("unit").string() == "sigma");
  const Json& channel = map.at("channels")[0];
  std::size_t found = 0;
  for (std::size_t k = 0; k < map.at("theta_i_deg").size(); ++k) {
    const bool there = map.at("theta_i_deg")[k].number() == 65 && map.at("theta_o_deg")[k].number() > 60;
    CHECK((channel.at("mean")[k].number() > 5) == there);
    found += there;
  }
  CHECK(found == 2);
  const auto drawn = run_gonio(fit + "--residual-map '" + png + "'");
  INFO(drawn.err);
  CHECK(drawn.out.find("misses most at theta_i 60 to 70°, theta_o 70 to 80°") != std::string::npos);
  CHECK(test::read_file(png).substr(1, 3) == "PNG");
  CHECK(run_gonio("fit '" + folder.path().string() + "' --model lambert --residual-map '" + png + "'").code == 2);
}

TEST_CASE("fit --weights none ignores the uncertainties, --weights solid_angle wants a grid") {
  const test::TemporaryFolder folder;
  std::string with_u = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n",
              without = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n";
  for (int theta_i = 0; theta_i < 80; theta_i += 20)
    for (int theta = 0; theta < 80; theta += 2) {
      const std::string row = std::to_string(theta_i) + ",0," + std::to_string(theta) + ",180," +
                              std::to_string(.1 + std::exp(-.01 * (theta - theta_i) * (theta - theta_i)));
      with_u += row + "," + std::to_string(.001 + .0001 * theta) + "\n", without += row + "\n";
    }
  test::write_file(folder / "u.csv", with_u);
  test::write_file(folder / "bare.csv", without);
  test::write_file(folder / "scattered.csv", without + "11,3,17,29,0.1\n22,5,33,111,0.1\n44,7,55,231,0.1\n");
  const auto fit = [&](const char* file, const char* flags) {
    return run_gonio("fit '" + (folder / file).string() + "' --model blinn-phong --json " + flags);
  };
  const Json ignored = fit("u.csv", "--weights none").json(), bare = fit("bare.csv", "--weights none").json();
  CHECK(ignored.at("weighting").at("source").string() == "none");
  CHECK(ignored.at("errors").at("chi2_per_dof").is_null());
  CHECK(ignored.at("parameters").dump() == bare.at("parameters").dump());
  CHECK(ignored.at("parameters").dump() != fit("u.csv", "").json().at("parameters").dump());
  const auto measured = fit("u.csv", "--weights solid_angle");
  CHECK(measured.code == 0);
  CHECK(faults_of(measured.json(), Schema::fit, "fit").empty());
  CHECK(measured.json().at("weighting").at("source").string() == "solid_angle");
  CHECK(measured.json().at("parameters").dump() != ignored.at("parameters").dump());
  const auto refused = fit("scattered.csv", "--weights solid_angle");
  CHECK(refused.code == 2);
  CHECK(refused.err.find("scattered directions") != std::string::npos);
}

TEST_CASE("fit prints a line a parameter for few channels and a line a channel for many, none of them longer than a wide terminal") {
  const test::TemporaryFolder folder;
  const auto lines_of = [&](int channels) {
    std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg";
    for (int c = 0; c < channels; ++c) text += "," + std::to_string(400 + 50 * c) + "nm";
    for (int theta = 0; theta < 80; theta += 2) {
      text += "\n30,0," + std::to_string(theta) + ",180";
      for (int c = 0; c < channels; ++c) text += "," + std::to_string(.1 * (c + 1) + std::exp(-.01 * (theta - 30) * (theta - 30)));
    }
    test::write_file(folder / "samples.csv", text + "\n");
    const std::string out = run_gonio("fit '" + (folder / "samples.csv").string() + "' --model blinn-phong --metric linear").out;
    std::vector<std::string> lines;
    for (std::size_t at = 0, end; (end = out.find('\n', at)) != out.npos; at = end + 1) lines.push_back(out.substr(at, end - at));
    return lines;
  };
  const auto count = [](const std::vector<std::string>& lines, const char* what) {
    return std::count_if(lines.begin(), lines.end(), [&](const std::string& line) { return line.find(what) != line.npos; });
  };
  const auto one = lines_of(1), many = lines_of(6);
  CHECK(count(one, "95 % interval [") == 3);
  CHECK(count(one, "channel") == 0);
  CHECK(count(many, "95 % interval [") == 1);
  CHECK(count(many, "  channel  rho_d") == 1);
  for (int c = 0; c < 6; ++c) CHECK(count(many, (std::to_string(400 + 50 * c) + "nm ").c_str()) >= 1);
  for (const auto& lines : {one, many})
    for (const std::string& line : lines) CHECK(line.size() <= 125);
}
