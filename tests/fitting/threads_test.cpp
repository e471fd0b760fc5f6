// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/threads.hpp"

#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/check.hpp"

using gonio::fitting::for_each_index;

TEST_CASE("every index is worked on once, whatever the number of threads") {
  for (const int threads : {0, 1, 2, 7}) {
    CAPTURE(threads);
    std::vector<int> visits(1000, 0);
    for (int round = 0; round < 50; ++round) for_each_index(visits.size(), threads, [&](std::size_t k) { ++visits[k]; });
    CHECK(visits == std::vector<int>(1000, 50));
  }
  for_each_index(0, 4, [](std::size_t) { FAIL("there is no index below 0"); });
}

TEST_CASE("no more threads work than were asked for") {
  std::mutex guard;
  std::set<std::thread::id> seen;
  for_each_index(10000, 3, [&](std::size_t) {
    const std::lock_guard lock(guard);
    seen.insert(std::this_thread::get_id());
  });
  CHECK(seen.size() <= 3);
}

TEST_CASE("work may itself be divided among threads, more than there are") {
  std::vector<std::vector<int>> visits(20, std::vector<int>(200, 0));
  for_each_index(visits.size(), 4, [&](std::size_t row) { for_each_index(200, 4, [&](std::size_t k) { ++visits[row][k]; }); });
  CHECK(visits == std::vector<std::vector<int>>(20, std::vector<int>(200, 1)));
}

TEST_CASE("work from several threads at a time ends for each of them") {
  std::vector<long> sums(6, 0);
  {
    std::vector<std::jthread> callers;
    for (std::size_t caller = 0; caller < sums.size(); ++caller)
      callers.emplace_back([&sums, caller] {
        for (int round = 0; round < 100; ++round) {
          std::atomic<long> sum{0};
          for_each_index(100, 3, [&](std::size_t k) { sum += static_cast<long>(k); });
          sums[caller] += sum;
        }
      });
  }
  CHECK(sums == std::vector<long>(6, 495000));
}

TEST_CASE("an exception comes back once every thread has ended, and the next work is done") {
  std::atomic<int> working{0};
  CHECK_THROWS_AS(for_each_index(100, 4,
                                 [&](std::size_t k) {
                                   ++working;
                                   --working;
                                   if (k == 17) throw std::runtime_error("17");
                                 }),
                  std::runtime_error);
  CHECK(working == 0);
  std::atomic<int> done{0};
  for_each_index(100, 4, [&](std::size_t) { ++done; });
  CHECK(done == 100);
}
