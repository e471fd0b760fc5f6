// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/in_parallel.hpp"

#include <atomic>
#include <stdexcept>
#include <vector>

#include "tests/check.hpp"

using gonio::tabulated::in_parallel;

TEST_CASE("Every piece of work is done once, whatever the number of threads") {
  for (const int threads : {0, 1, 3}) {
    std::vector<std::atomic<int>> done(1000);
    in_parallel(done.size(), threads, [&](std::size_t k) { ++done[k]; });
    for (const auto& times : done) CHECK(times == 1);
  }
}

TEST_CASE("A piece of work that fails stops the rest and its exception comes back") {
  std::atomic<std::size_t> calls{0};
  CHECK_THROWS_AS(in_parallel(1000000, 2,
                              [&](std::size_t k) {
                                ++calls;
                                if (k == 3) throw std::runtime_error("three");
                              }),
                  std::runtime_error);
  CHECK(calls < 1000000);
}
