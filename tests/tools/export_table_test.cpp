// SPDX-License-Identifier: BSD-3-Clause
// gonio export of samples: the table they become, what is said about it, and every format at once.
#include <cmath>
#include <sstream>

#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// Samples of a lobe in steps of 20° by 5° by 15°, with u; `tilt` makes them non-reciprocal.
std::filesystem::path samples_in(const test::TemporaryFolder& folder, double tilt = 0) {
  std::string directions;
  for (int ti = 10; ti <= 70; ti += 20)
    for (int to = 0; to <= 80; to += 5)
      for (int phi = 0; phi < 360; phi += 15)
        if (to > 0 || phi == 0) directions += std::to_string(ti) + " 0 " + std::to_string(to) + " " + std::to_string(phi) + "\n";
  const auto values = run_gonio("eval blinn-phong --param rho_d=.2 --param rho_s=.3 --param s=100", directions);
  std::string rows =
      "# gonio samples 1\n# channel.1: value\n# symmetry: isotropic\n# side: reflection\n"
      "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n";
  std::istringstream lines(directions), f(values.out);
  for (std::string line, value; std::getline(lines, line) && std::getline(f, value);) {
    const double number = std::stod(value) * (1 + tilt * std::cos(std::stod(line) * 0.0174533));
    for (char& c : line)
      if (c == ' ') c = ',';
    rows += line + "," + std::to_string(number) + "," + std::to_string(0.01 * number) + "\n";
  }
  test::write_file(folder / "samples.csv", rows);
  return folder / "samples.csv";
}

Json exported(const std::string& arguments) {
  const auto outcome = run_gonio("export " + arguments + " --json");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const Json document = outcome.json();
  for (const Fault& fault : faults_of(document, Schema::export_files, "export")) FAIL(fault.where << ": " << fault.found);
  return document;
}

}  // namespace

TEST_CASE("the guide is chosen by what it predicts, said in the notes, and better than none") {
  const test::TemporaryFolder folder;
  const auto samples = samples_in(folder);
  const std::string to = " --to csv --resample --size paper --out " + quoted(folder / "table.csv");
  const Json document = exported(quoted(samples) + to);
  const auto& guides = document.at("table").at("guides").elements();
  REQUIRE(guides.size() > 3);
  CHECK(guides[0].at("name").string().find("blinn-phong") == 0);
  CHECK(guides[0].at("error_incidence").number() < 0.001);
  const Json none = exported(quoted(samples) + to + " --guide none").at("table").at("guides").elements()[0];
  CHECK(none.at("error_incidence").number() > 10 * guides[0].at("error_incidence").number());
}

TEST_CASE("a table that interpolates by itself is not interpolated anew") {
  const test::TemporaryFolder folder;
  const std::string table = quoted(folder / "table.ssdd"), again = quoted(folder / "again.mbsdf");
  exported(quoted(samples_in(folder)) + " --to ssdd --size paper --guide blinn-phong --out " + table);
  const Json guides = exported(table + " --to mbsdf --size paper --out " + again).at("table");
  CHECK((guides.is_null() || guides.at("guides").size() == 0));
  const std::string at = "30 0 40 170\n";
  CHECK(std::stod(run_gonio("eval " + again, at).out) == Approx(std::stod(run_gonio("eval " + table, at).out)).epsilon(0.02));
}

TEST_CASE("samples stay as they are unless a table is asked for; the table carries uncertainty and coverage") {
  const test::TemporaryFolder folder;
  const auto samples = samples_in(folder);
  const std::string to = " --to csv --size paper --out " + quoted(folder / "table.csv");
  CHECK(exported(quoted(samples) + to).at("table").is_null());
  CHECK(test::read_file(folder / "table.csv").find("coverage") == std::string::npos);
  const Json all = exported(quoted(samples) + to + " --resample --guide blinn-phong");
  CHECK(test::read_file(folder / "table.csv").find(",value,u_value,coverage") != std::string::npos);
  CHECK(all.at("notes").at("n_extrapolated").number() > 0);
  const Json measured = exported(quoted(samples) + to + " --resample --guide blinn-phong --extrapolate no");
  CHECK(measured.at("notes").at("n_extrapolated").number() == 0);
  CHECK(measured.at("notes").at("n_unknown").number() == all.at("notes").at("n_extrapolated").number());
}

TEST_CASE("imposed symmetry says what it changed, and changes nothing where the samples have it") {
  const test::TemporaryFolder folder;
  const std::string to = " --to csv --size paper --guide blinn-phong --impose reciprocity --out " + quoted(folder / "table.csv");
  const auto change = [&](double tilt) { return exported(quoted(samples_in(folder, tilt)) + to).at("table").at("imposed").elements()[0]; };
  const Json tilted = change(0.2), straight = change(0);
  CHECK(tilted.at("symmetry").string() == "reciprocity");
  CHECK(tilted.at("p95").number() > 0.03);
  CHECK(tilted.at("p95").number() <= tilted.at("largest").number());
  CHECK(straight.at("p95").number() < 0.005);
  CHECK(run_gonio("export x.csv --to csv --out y.csv --impose symmetry").code == 2);
}

TEST_CASE("--all writes every format that takes the data, lists those that refuse, and a page and a document of notes") {
  const test::TemporaryFolder folder;
  const auto samples = samples_in(folder), fit = folder / "fit.json", out = folder / "all";
  REQUIRE(run_gonio("fit " + quoted(samples) + " --model blinn-phong --out " + quoted(fit)).code == 0);
  const Json document = exported(quoted(fit) + " --size paper --all " + quoted(out));
  CHECK(document == load_document(out / "notes.json", Schema::export_files));
  const auto& exports = document.at("exports").elements();
  REQUIRE(exports.size() > 5);
  const std::string page = test::read_file(out / "notes.md");
  std::size_t compared = 0, close = 0;
  for (const Json& file : exports) {
    INFO(file.at("format").string());
    CHECK(std::filesystem::file_size(file.at("out").string()) > 0);
    CHECK(page.find("| " + file.at("format").string() + " |") != std::string::npos);
    if (!file.at("round_trip").contains("mean")) continue;
    const double mean = file.at("round_trip").at("mean").number();
    ++compared, close += mean < 0.05;
    CHECK(mean < 1);  // three numbers, as in ABg, hold less than a table
  }
  CHECK(compared > 5);
  CHECK(close > 5);
  for (const Json& refused : document.at("refused").elements()) CHECK(!refused.at("reason").string().empty());
}

TEST_CASE("flags that do not go together are refused before anything is written") {
  CHECK(run_gonio("export x.csv").code == 2);
  CHECK(run_gonio("export x.csv --to merl").code == 2);
  CHECK(run_gonio("export x.csv --all there --to merl --out y").code == 2);
  CHECK(run_gonio("export x.csv --to csv --out y --extrapolate yes").code == 2);
  CHECK(run_gonio("export x.csv --to csv --out y --mask-retro 90").code == 2);
}

TEST_CASE("Samples of one incident azimuth become no table of guesses unless isotropy or extrapolation is asked for") {
  const test::TemporaryFolder folder;
  std::string text = test::read_file(samples_in(folder));
  const std::string stated = "# symmetry: isotropic\n";
  text.erase(text.find(stated), stated.size());
  test::write_file(folder / "one.csv", text);
  const std::string source = quoted(folder / "one.csv") + " --guide blinn-phong --size paper",
                    to = " --to rgl --out " + quoted(folder / "one.bsdf");
  const auto refused = run_gonio("export " + source + to);
  CHECK(refused.code == 3);
  CHECK(refused.err.find("one azimuth (0 deg)") != std::string::npos);
  CHECK(refused.err.find("--impose isotropy") != std::string::npos);
  CHECK(!std::filesystem::exists(folder / "one.bsdf"));

  const Json isotropic = exported(source + to + " --impose isotropy");
  CHECK(isotropic.at("table").at("part_beyond").number() < 0.5);
  CHECK(isotropic.at("table").at("one_azimuth_deg").is_null());
  CHECK(isotropic.at("notes").at("n_extrapolated").number() < 0.5 * isotropic.at("notes").at("n_nodes").number());

  const Json guessed = exported(source + to + " --extrapolate model");
  CHECK(guessed.at("table").at("part_beyond").number() > 0.8);
  CHECK(guessed.at("table").at("one_azimuth_deg").number() == 0);
  CHECK(guessed.at("notes").at("n_extrapolated").number() > 0.5 * guessed.at("notes").at("n_nodes").number());

  const Json all = exported(source + " --all " + quoted(folder / "all"));
  const auto written = [&](const std::string& format) {
    for (const Json& file : all.at("exports").elements())
      if (file.at("format").string() == format) return true;
    return false;
  };
  CHECK(written("csv"));  // keeps the samples
  CHECK(written("mitsuba"));
  CHECK(!written("rgl"));
  std::size_t with_reason = 0;
  for (const Json& one : all.at("refused").elements())
    with_reason += one.at("reason").string().find("--impose isotropy") != std::string::npos;
  CHECK(with_reason > 10);
}
