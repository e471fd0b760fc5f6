// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/error.hpp"

#include <string>

#include "tests/check.hpp"

using namespace gonio;

TEST_CASE("an error says where, what was found and what was wanted, fault by fault") {
  const Error error(ErrorKind::input, "the plan cannot be used",
                    {{"plan.json#/theta_i", "\"ten\"", "a number"}, {"plan.json#/seed", "-1", "0 or more"}});
  const std::string text = error.what();
  CHECK(text ==
        "the plan cannot be used\n  plan.json#/theta_i: found \"ten\", wanted a number\n  plan.json#/seed: found -1, wanted 0 or more");
  CHECK(std::string(name(error.kind())) == "input");
  CHECK(std::string(Error(ErrorKind::device, Fault{"meter", "no answer", "a reading"}).what()) ==
        "meter: found no answer, wanted a reading");
}
