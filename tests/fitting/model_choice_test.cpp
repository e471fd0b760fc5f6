// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/model_choice.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include "brdf/error.hpp"
#include "tests/fitting/synthetic.hpp"
#include "tests/shared_data.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::fitting;

namespace {

ChoiceOptions options_with(std::vector<std::string> models) {
  ChoiceOptions out;
  out.models = std::move(models);
  return out;
}

ModelChoice choose(const std::shared_ptr<Dataset>& data, const ChoiceOptions& options) { return choose_model(observe(data), options); }

const Candidate& candidate(const ModelChoice& choice, const std::string& model) {
  for (const Candidate& c : choice.candidates)
    if (c.model == model) return c;
  FAIL("no " << model);
  return choice.candidates.front();
}

/// θi, θo cos φ, θo sin φ in radians and f cos θo; rows at 90° have no f.
std::shared_ptr<Dataset> retro_tape(const std::filesystem::path& path) {
  auto out = std::make_shared<Dataset>();
  out->channels = single_channel("value");
  out->f.resize(1);
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream row(line);
    double theta_i, x, y, f_cos;
    if (line.starts_with('#') || !(row >> theta_i >> x >> y >> f_cos)) continue;
    const double theta_o = std::hypot(x, y);
    if (theta_o > degrees(89).radians()) continue;
    out->angles.push_back({radians(theta_i), degrees(0), radians(theta_o), radians(std::atan2(y, x))});
    out->f[0].push_back(f_cos / std::cos(theta_o));
  }
  return out;
}

}  // namespace

TEST_CASE("the true model is best and adequate, wrong ones are not, and the simplest of equals is named") {
  const auto data = test::readings(test::lobe("blinn-phong", 0.2, 0.3, 40), test::polar_grid({10, 30, 50, 70}, 5, 15),
                                   {.read = 1e-4, .relative = 0.02}, 11);
  const ModelChoice choice = choose(data, options_with({"lambert", "phong", "phong-1975", "blinn-phong"}));
  INFO(choice.verdict);
  CHECK(choice.folds.over == Folds::Over::incidences);
  CHECK(choice.any_adequate);
  CHECK(choice.single_lobe_adequate);
  CHECK(choice.simplest == "blinn-phong");
  CHECK(choice.noise.source == NoiseLevel::Source::stated);
  const Candidate &truth = candidate(choice, "blinn-phong"), &flat = candidate(choice, "lambert"), &mirror = candidate(choice, "phong");
  CHECK(truth.adequate);
  CHECK(*truth.relative_error < 0.02);
  CHECK_FALSE(flat.adequate);
  CHECK_FALSE(mirror.adequate);
  CHECK(*truth.aicc + 10 < *mirror.aicc);
  CHECK(*truth.bic + 10 < *mirror.bic);
  CHECK(*truth.score < 1.01);
  CHECK(*mirror.score > 2);
  for (const Metric metric : ranking_metrics) {
    const auto m = static_cast<std::size_t>(metric);
    CHECK(*truth.rank[m] == 1);
    CHECK(*mirror.rank[m] == *candidate(choice, "phong-1975").rank[m]);  // one lobe, two normalisations
    CHECK(*flat.rank[m] == 4);
  }
  CHECK(candidate(choice, "phong-1975").reason == "it fits as phong does");
  CHECK(choice.candidates.back().model == "lambert");
}

TEST_CASE("two lobes: no single one is adequate, and the profile hints at the second") {
  // In plane, half angles as dense near the mirror direction as in MERL's tables.
  const AnalyticBrdf truth("blinn-phong-ngan+blinn-phong-ngan", single_channel("Y"), {{0.2, 0.3, 0.3, 20, 4000}});
  std::vector<GonioAngles> angles;
  for (const double theta_i : {10, 30, 50})
    for (int k = 0; k < 60; ++k)
      for (const double side : {-1, 1}) {
        const double theta_o = theta_i + side * 2 * k * k / 90.0;
        if (std::abs(theta_o) < 85) angles.push_back({degrees(theta_i), degrees(0), degrees(theta_o), degrees(180)});
      }
  const auto data = test::readings(truth, angles, {.read = 1e-4, .relative = 0.01}, 12);
  const ModelChoice choice = choose(data, options_with({"blinn-phong-ngan", "phong"}));
  INFO(choice.verdict);
  CHECK_FALSE(choice.any_adequate);
  CHECK(choice.verdict.starts_with("no adequate single-lobe model: the best, "));
  INFO(candidate(choice, "blinn-phong-ngan").hint);
  CHECK(candidate(choice, "blinn-phong-ngan").hint.ends_with("often a second lobe, try blinn-phong-ngan+blinn-phong-ngan"));
}

TEST_CASE("a model that cannot be set up is listed last with its reason, and a lobe that is not there is said to be unknown") {
  const auto data =
      test::readings(AnalyticBrdf("lambert", single_channel("Y"), {{0.3}}), test::polar_grid({10, 30, 50}, 10, 30), {.relative = 0.01}, 13);
  ChoiceOptions options = options_with({"lambert", "phong"});
  ModelChoice choice = choose(data, options);
  CHECK(choice.simplest == "lambert");
  CHECK(candidate(choice, "lambert").adequate);
  CHECK(candidate(choice, "phong").reason.find("do not determine") != std::string::npos);
  options.fit.fixed["s"] = 20;
  choice = choose(data, options);
  CHECK(choice.candidates.back().model == "lambert");
  CHECK_FALSE(choice.candidates.back().ranked);
  CHECK(choice.candidates.back().reason.find("'s'") != std::string::npos);
  CHECK(choice.best == "phong");
  CHECK_THROWS_AS(choose(data, options_with({"no-such-model"})), Error);
}

TEST_CASE("data without any usable value choose nothing, and a handful cannot be cross-validated") {
  auto data = std::make_shared<Dataset>();
  data->channels = single_channel("Y");
  data->angles = test::polar_grid({10, 30}, 20, 60);
  data->f = {std::vector<double>(data->size(), std::nan(""))};
  const ModelChoice nothing = choose(data, options_with({"lambert", "phong"}));
  CHECK_FALSE(nothing.best);
  CHECK(nothing.verdict == "no model could be fitted");
  for (std::size_t k = 0; k < 5; ++k) data->f[0][k] = 0.1;
  const ModelChoice few = choose(data, options_with({"lambert"}));
  CHECK(few.best == "lambert");
  CHECK_FALSE(few.any_adequate);
  CHECK(few.verdict.find("too few samples") != std::string::npos);
}

TEST_CASE("the choice does not depend on the number of threads, and stops when told") {
  const auto data = test::readings(test::lobe("phong", 0.2, 0.3, 40), test::polar_grid({10, 30, 50}, 10, 20), {.relative = 0.05}, 14);
  ChoiceOptions options = options_with({"lambert", "phong", "blinn-phong"});
  options.jobs = 1;
  const ModelChoice one = choose(data, options);
  options.jobs = 4;
  std::atomic<int> fits{0};
  options.fitted = [&](std::size_t total) {
    ++fits;
    CHECK(total == 12);
  };
  const ModelChoice four = choose(data, options);
  CHECK(fits == 12);
  REQUIRE(one.candidates.size() == four.candidates.size());
  for (std::size_t m = 0; m < one.candidates.size(); ++m) {
    CHECK(one.candidates[m].model == four.candidates[m].model);
    CHECK(one.candidates[m].cross_validated == four.candidates[m].cross_validated);
  }
  const std::atomic<bool> stop{true};
  options.stop = &stop;
  CHECK_THROWS_AS(choose(data, options), Error);
}

TEST_CASE("no single lobe is adequate for a retro-reflecting tape") {
  const auto path = test::measured_data("alta_retro/retro-3M-jaune.dat");
  if (!path) return;
  std::vector<std::string> models;
  for (const ModelInfo& info : model_infos())
    if (info.nonlinear_count() <= 1 && !info.name.starts_with("retro")) models.push_back(info.name);
  const ModelChoice choice = choose(retro_tape(*path), options_with(models));
  INFO(choice.verdict);
  CHECK_FALSE(choice.single_lobe_adequate);
  CHECK(choice.verdict.starts_with("no adequate single-lobe model"));
  for (const Candidate& c : choice.candidates)
    if (c.ranked) CHECK(*c.relative_error > 0.4);
}
