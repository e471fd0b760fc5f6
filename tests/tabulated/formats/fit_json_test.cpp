// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/fit_json.hpp"

#include <random>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

namespace {

/// The example fit of data-schemas, changed by `change`.
template <class Change>
std::string example(Change&& change) {
  Json document = parse_json(read_file(std::string(GONIO_SOURCE_DIR) + "/data-schemas/examples/valid/converged.fit.json"), "example");
  change(document);
  return document.dump();
}

Json parameter(const char* name, Json channel, Json value) {
  return Json::object({{"name", name},
                       {"channel", std::move(channel)},
                       {"value", std::move(value)},
                       {"sigma", Json()},
                       {"interval", Json()},
                       {"kind", "fixed"},
                       {"lower", Json()},
                       {"upper", Json()}});
}

std::string with_parameters(Json::Array parameters) {
  return example([&](Json& document) { document.set("parameters", Json(std::move(parameters))); });
}

const Direction wi = Direction::spherical(30_deg, 0_deg), wo = Direction::spherical(40_deg, 170_deg);

}  // namespace

TEST_CASE("A fit opens as the model with its values") {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(scratch.file("fit.json", example([](Json&) {})));
  CHECK(opened.format == "fit-json");
  CHECK(opened.simulated);
  CHECK_FALSE(opened.dataset);
  CHECK_FALSE(opened.observations);
  REQUIRE(opened.brdf);
  const AnalyticBrdf expected("blinn-phong", single_channel("550nm"), {{0.2496, 0.352, 41.3}});
  CHECK(opened.brdf->channels() == expected.channels());
  CHECK(opened.brdf->eval(wi, wo) == expected.eval(wi, wo));
}

TEST_CASE("A parameter belongs to its channel, or without one to all") {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(
      scratch.file("fit.json", with_parameters({parameter("rho_d", "r", 0.1), parameter("rho_d", "g", 0.2), parameter("rho_s", "r", 0.3),
                                                parameter("rho_s", "g", 0.4), parameter("s", Json(), 10)})));
  Channels two = rgb_channels();
  two.pop_back();
  CHECK(opened.brdf->eval(wi, wo) == AnalyticBrdf("blinn-phong", two, {{0.1, 0.3, 10}, {0.2, 0.4, 10}}).eval(wi, wo));
}

TEST_CASE("A fit without usable values is refused with what is missing") {
  const TemporaryFolder scratch;
  const auto refusal = [&](const std::string& text) { return faults_of([&] { open_brdf(scratch.file("fit.json", text)); }); };
  CHECK(refusal(with_parameters({parameter("rho_d", "r", 0.1), parameter("s", Json(), 10)})).find("no value of rho_s for channel r") !=
        std::string::npos);
  CHECK(refusal(with_parameters({parameter("rho_d", "r", -0.1), parameter("rho_s", "r", 0.1), parameter("s", Json(), 10)}))
            .find("rho_d = -0.1") != std::string::npos);
  CHECK(refusal(example([](Json& document) { document.set("status", "failed"); })).find("#/status|'failed'|") != std::string::npos);
  CHECK(refusal(example([](Json& document) { document.set("model", "wood"); })).find("#/model|'wood'|one of lambert") != std::string::npos);
  CHECK(refusal(example([](Json& document) { document.set("metric", 3); })).find("input|") == 0);
  CHECK(refusal("{\"context\":").find("input|") == 0);
  CHECK(refusal("{\"plan\":1}").find("unknown kind") != std::string::npos);
}

TEST_CASE("A fit that did not converge opens and says so") {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(scratch.file("fit.json", example([](Json& document) {
                                                 document.set("status", "not_converged");
                                                 document.set("reason", "a ridge");
                                               })));
  CHECK(std::find(opened.info.begin(), opened.info.end(), std::pair<std::string, std::string>("status", "not_converged")) !=
        opened.info.end());
}

TEST_CASE("No damaged fit does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string whole = example([](Json&) {});
  std::mt19937 random(20260707);
  for (int round = 0; round < 1000; ++round) {
    std::string text = whole;
    for (std::size_t edit = 0, edits = 1 + random() % 4; edit < edits; ++edit)
      text[random() % text.size()] = static_cast<char>(random() % 128);
    if (random() % 10 == 0) text.resize(random() % text.size());
    INFO("round " << round << " of seed 20260707");
    ReadOptions options;
    options.format = "fit-json";
    try {
      open_brdf(scratch.file("fit.json", text), options).brdf->eval(wi, wo);
    } catch (const Error& error) {
      REQUIRE(error.kind() == ErrorKind::input);
    }
  }
  SUCCEED();
}
