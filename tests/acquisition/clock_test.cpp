// SPDX-License-Identifier: BSD-3-Clause
// The virtual clock's baton and the real clock.
#include "acquisition/clock.hpp"

#include <thread>
#include <vector>

#include "tests/check.hpp"

using namespace gonio::acquisition;

TEST_CASE("Virtual time moves only by sleeping, and never back") {
  VirtualClock clock;
  CHECK(clock.is_virtual());
  CHECK(clock.now() == 0);
  clock.sleep_until(5 * second);
  CHECK(clock.now() == 5 * second);
  clock.sleep_until(3 * second);
  CHECK(clock.now() == 5 * second);
}

TEST_CASE("With several members the earliest wake alone runs, ties by number") {
  for (int round = 0; round < 20; ++round) {
    constexpr int members = 3;
    VirtualClock clock(members);
    std::vector<std::pair<BenchTime, int>> order;  // unguarded on purpose: only one member runs at a time
    std::vector<std::thread> threads;
    const BenchTime period[members] = {20, 30, 60};
    for (int m = 0; m < members; ++m) {
      threads.emplace_back([&, m] {
        clock.sleep_until(0, m);
        for (BenchTime t = 0; t < 240; t = clock.now()) {
          order.emplace_back(t, m);
          clock.sleep_until(t + period[m], m);
        }
        clock.leave(m);
      });
    }
    for (std::thread& thread : threads) thread.join();
    std::vector<std::pair<BenchTime, int>> expected;
    for (BenchTime t = 0; t < 240; ++t) {
      for (int m = 0; m < members; ++m) {
        if (t % period[m] == 0) expected.emplace_back(t, m);
      }
    }
    CHECK(order == expected);
  }
}

TEST_CASE("The real clock runs by itself, from where it is told to begin") {
  RealClock clock(7 * second);
  CHECK_FALSE(clock.is_virtual());
  const BenchTime begin = clock.now();
  CHECK(begin >= 7 * second);
  clock.sleep_until(begin + second / 1000);
  CHECK(clock.now() >= begin + second / 1000);
  clock.sleep_until(0);  // has passed
}

TEST_CASE("Seconds become bench time without waking too early") {
  CHECK(bench_time(0) == 0);
  CHECK(bench_time(1) == second);
  CHECK(bench_time(1e-10) == 1);
  CHECK(seconds(bench_time(0.25)) == 0.25);
}
