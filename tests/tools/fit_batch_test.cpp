// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

std::string lambert(double rho) {
  std::string text = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n";
  for (int theta = 0; theta < 80; theta += 5) text += "30,0," + std::to_string(theta) + ",180," + std::to_string(rho) + "\n";
  return text;
}

/// Ten files of which one is no table and one cannot be fitted in the logarithm.
void fill(const test::TemporaryFolder& folder) {
  std::filesystem::create_directory(folder / "in");
  for (int k = 0; k < 8; ++k) test::write_file(folder / "in" / ("m" + std::to_string(k) + ".csv"), lambert(0.1 + 0.01 * k));
  test::write_file(folder / "in" / "broken.csv", lambert(0.1) + "30,0,90,180\n");
  test::write_file(folder / "in" / "negative.csv", lambert(-0.1));
  test::write_file(folder / "in" / "notes.md", "no measurement");
}

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(parse_json(line, "line"));
  return out;
}

std::string file_of(const Json& line) {
  return std::filesystem::path(line.contains("error") ? line.at("file").string() : line.at("context").at("inputs")[0].at("path").string())
      .filename();
}

std::vector<std::string> files_of(const std::vector<Json>& lines) {
  std::vector<std::string> out;
  for (const Json& line : lines) out.push_back(file_of(line));
  return out;
}

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

}  // namespace

TEST_CASE("a folder gives one valid line a file, errors among them, and the worst exit code") {
  const test::TemporaryFolder folder;
  fill(folder);
  const auto outcome = run_gonio("fit " + quoted(folder / "in") + " --model lambert --metric log --jobs 2");
  INFO(outcome.err);
  CHECK(outcome.code == 3);
  const std::vector<Json> lines = lines_of(outcome.out);
  REQUIRE(lines.size() == 10);
  std::size_t errors = 0, unusable = 0;
  for (const Json& line : lines) {
    CHECK(faults_of(line, Schema::fit_line, "line").empty());
    errors += line.contains("error");
    unusable += !line.contains("error") && line.at("status").string() == "no_usable_data";
  }
  CHECK(errors == 1);
  CHECK(unusable == 1);
  CHECK(outcome.err.find("8 converged, 1 not converged, 1 failed") != std::string::npos);
  std::filesystem::remove(folder / "in" / "broken.csv");
  CHECK(run_gonio("fit " + quoted(folder / "in") + " --model lambert --metric log").code == 1);
  CHECK(run_gonio("fit " + quoted(folder / "in") + " --model lambert --metric linear").code == 0);
}

TEST_CASE("ordered lines come in the order of the files, the same from one thread and from several") {
  const test::TemporaryFolder folder;
  fill(folder);
  const auto lines = [&](const char* jobs) {
    return lines_of(run_gonio("fit " + quoted(folder / "in") + " --model lambert --ordered --jobs " + jobs).out);
  };
  const std::vector<Json> one = lines("1"), many = lines("4");
  const std::vector<std::string> files = files_of(one);
  CHECK(std::is_sorted(files.begin(), files.end()));
  CHECK(files == files_of(many));
  REQUIRE(one.size() == many.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    if (one[k].contains("error")) continue;
    CHECK(one[k].at("parameters") == many[k].at("parameters"));
  }
}

TEST_CASE("a batch that was torn off goes on where it stood, and does again what another option or another content asks for") {
  const test::TemporaryFolder folder;
  fill(folder);
  const auto out = folder / "results.jsonl";
  const std::string command = "fit " + quoted(folder / "in") + " --model lambert --metric log --jobs 1 --ordered --out " + quoted(out);
  REQUIRE(run_gonio(command).code == 3);
  const std::string whole = test::read_file(out);
  CHECK(run_gonio(command).code == 2);  // an existing file is not overwritten
  CHECK(test::read_file(out) == whole);

  // Everything stands there: nothing is added, and the exit code is that of the whole.
  auto again = run_gonio(command + " --resume");
  CHECK(again.code == 3);
  CHECK(again.err.find("10 of them stood there") != std::string::npos);
  CHECK(test::read_file(out) == whole);

  // Torn in the middle of a line.
  test::write_file(out, whole.substr(0, whole.size() * 6 / 10));
  again = run_gonio(command + " --resume");
  CHECK(again.code == 3);
  auto files = files_of(lines_of(test::read_file(out)));
  std::sort(files.begin(), files.end());
  CHECK(files == files_of(lines_of(whole)));

  test::write_file(folder / "in" / "m3.csv", lambert(0.9));
  again = run_gonio(command + " --resume");
  CHECK(again.err.find("9 of them stood there") != std::string::npos);
  const std::vector<Json> lines = lines_of(test::read_file(out));
  REQUIRE(lines.size() == 11);
  CHECK(file_of(lines.back()) == "m3.csv");
  again = run_gonio("fit " + quoted(folder / "in") + " --model lambert --metric cbrt --out " + quoted(out) + " --resume");
  CHECK(again.err.find("0 of them stood there") != std::string::npos);
}

TEST_CASE("files can be named one by one, in a list, or fitted together") {
  const test::TemporaryFolder folder;
  fill(folder);
  const auto file = [&](int k) { return folder / "in" / ("m" + std::to_string(k) + ".csv"); };
  const std::string list = file(0).string() + "\n\n" + file(2).string() + "\n";
  const auto listed = run_gonio("fit --files-from - --model lambert --ordered", list);
  CHECK(files_of(lines_of(listed.out)) == std::vector<std::string>{"m0.csv", "m2.csv"});
  const auto missing = run_gonio("fit " + quoted(file(0)) + " nowhere.csv --model lambert --ordered");
  CHECK(missing.code == 3);
  REQUIRE(lines_of(missing.out).size() == 2);
  CHECK(lines_of(missing.out)[1].at("context").at("inputs").size() == 0);
  CHECK(run_gonio("fit " + quoted(file(0)) + " --lines --model lambert").out.find('\n') != std::string::npos);

  const auto together = run_gonio("fit " + quoted(file(0)) + " " + quoted(file(2)) + " --together --model lambert --json");
  REQUIRE(together.code == 0);
  const Json document = together.json();
  CHECK(faults_of(document, Schema::fit, "fit").empty());
  CHECK(document.at("context").at("inputs").size() == 2);
  CHECK(document.at("parameters")[0].at("value").number() == Approx(0.11 * std::acos(-1)).epsilon(1e-12));  // the mean of 0.10 and 0.12
  CHECK(run_gonio("fit " + quoted(file(0)) + " nowhere.csv --together --model lambert").code == 3);
}

TEST_CASE("wrong flags of a batch are refused before any line is written") {
  const test::TemporaryFolder folder;
  fill(folder);
  const std::string in = "fit " + quoted(folder / "in") + " --out " + quoted(folder / "r.jsonl") + " ";
  CHECK(run_gonio(in + "--model no-such-model").code == 2);
  CHECK(run_gonio(in + "--model lambert --jobs 0").code == 2);
  CHECK(run_gonio(in + "--model lambert --fix s=3").code == 2);
  CHECK(run_gonio("fit " + quoted(folder / "in") + " --model lambert --resume").code == 2);
  CHECK(run_gonio("fit --model lambert").code == 2);
}
