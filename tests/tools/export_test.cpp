// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "tests/command.hpp"

#include "tests/check.hpp"

using namespace gonio;
using test::run_gonio;

namespace {

/// A noiseless Lambert-plus-lobe data set and its fit in `folder`.
std::string make_fit(const test::TemporaryFolder& folder) {
  std::string directions, rows = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n";
  for (int ti = 0; ti <= 60; ti += 20)
    for (int to = 0; to <= 80; to += 4) directions += std::to_string(ti) + " 0 " + std::to_string(to) + " 180\n";
  const auto values = run_gonio("eval blinn-phong --param rho_d=.2 --param rho_s=.3 --param s=50", directions);
  std::istringstream lines(directions), f(values.out);
  for (std::string line, value; std::getline(lines, line) && std::getline(f, value);) {
    for (char& c : line)
      if (c == ' ') c = ',';
    rows += line + "," + value + "\n";
  }
  test::write_file(folder / "samples.csv", rows);
  const std::string fit = (folder / "fit.json").string();
  REQUIRE(run_gonio("fit '" + (folder / "samples.csv").string() + "' --model blinn-phong --out '" + fit + "'").code == 0);
  return fit;
}

}  // namespace

TEST_CASE("a fit exported as MERL has the right size, reads back and fits to itself only with the nodes it was written with") {
  const test::TemporaryFolder folder;
  const std::string fit = make_fit(folder), merl = (folder / "material.binary").string();
  REQUIRE(run_gonio("export '" + fit + "' --to merl --out '" + merl + "'").code == 0);
  CHECK(std::filesystem::file_size(merl) == 34992012);
  const auto exponent = [&](const std::string& flags) {
    const auto outcome = run_gonio("fit '" + merl + "' --model blinn-phong --json " + flags);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const Json document = outcome.json();
    for (const Json& p : document.at("parameters").elements())
      if (p.at("name").string() == "s") return p.at("value").number();
    return 0.0;
  };
  CHECK(exponent("") == Approx(50).epsilon(1e-6));
  CHECK(std::fabs(exponent("--merl-nodes centre") / 50 - 1) > 0.005);
}

TEST_CASE("a truncated or oversized MERL file is refused with found and wanted bytes") {
  const test::TemporaryFolder folder;
  const std::string fit = make_fit(folder), merl = (folder / "material.binary").string();
  REQUIRE(run_gonio("export '" + fit + "' --to merl --out '" + merl + "'").code == 0);
  for (const std::uintmax_t size : {std::uintmax_t{1000000}, std::uintmax_t{34992020}}) {
    std::filesystem::resize_file(merl, size);
    const auto outcome = run_gonio("fit '" + merl + "' --model blinn-phong");
    INFO(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(outcome.err.find("34992012") != std::string::npos);
    CHECK(outcome.err.find(std::to_string(size)) != std::string::npos);
  }
}
