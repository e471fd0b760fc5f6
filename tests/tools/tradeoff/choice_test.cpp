// SPDX-License-Identifier: BSD-3-Clause
#include "tools/tradeoff/tradeoff.hpp"

#include "tests/check.hpp"

using namespace gonio::tools::tradeoff;

namespace {

Point point(const char* panel, const char* method, const char* setting, double seconds, std::optional<double> error) {
  return {panel, method, setting, {seconds, seconds, seconds, 5}, error, "", false};
}

Measured two_panels() {
  Measured out;
  out.time_unit_s = 1e-6, out.time_unit = "µs";
  out.targets = {1e-2, 1e-6};
  out.points = {point("a", "slow", "", 5e-6, 1e-9),          point("b", "slow", "", 6e-6, 1e-8), point("a", "quick", "n = 2", 1e-6, 1e-3),
                point("b", "quick", "n = 2", 1e-6, 5e-3),    point("a", "only a", "", 1e-7, 0),  point("a", "broken", "", 1e-7, 1e-12),
                point("b", "broken", "", 1e-7, std::nullopt)};
  return out;
}

}  // namespace

TEST_CASE("the front holds what nothing else beats in both time and error, panel by panel") {
  auto points = two_panels().points;
  mark_front(points);
  const auto on_front = [&](std::size_t k) { return points[k].on_front; };
  CHECK_FALSE(on_front(0));  // "only a" is faster and nearer
  CHECK(on_front(1));
  CHECK_FALSE(on_front(2));
  CHECK(on_front(3));
  CHECK(on_front(4));
  CHECK_FALSE(on_front(5));
  CHECK_FALSE(on_front(6));  // no number is on no front
}

TEST_CASE("the advice names the cheapest setting that holds in every panel, and what holds nowhere") {
  Measured measured = two_panels();
  const std::string text = advice(measured);
  CHECK(text.find("For an error of at most 0.01 in every panel choose quick, n = 2: at most 1 µs (worst error 0.005, at b)") !=
        std::string::npos);
  CHECK(text.find("For an error of at most 1e-06 in every panel choose slow") != std::string::npos);
  CHECK(text.find("At every setting tried broken misses 0.01: no number at b") != std::string::npos);
  CHECK(text.find("only a") == std::string::npos);  // says nothing about panel b
  measured.points.resize(4);
  measured.points[1].error = 0.5;
  CHECK(advice(measured).find("No setting tried is within 1e-06 in every panel") != std::string::npos);
}
