// SPDX-License-Identifier: BSD-3-Clause
// How long lookups in a table of MERL's size take on one thread, and reading a MERL file beside cat: bench_lookups [RUNS].
//
// Two orders of pairs, 16 384 of each, looked up again and again: those of a picture of a sphere under one light, row by row (neighbours in
// the picture are neighbours in the table; 7 % of them are below the horizon), and uniformly random ones, every lookup somewhere else: what
// these touch of the table, 5 MB, is more than a processor keeps near. How much of their time is waiting for memory is what the same
// corners cost when they are only read and added. Lookups are timed on the clock of their thread, so other programs count little.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "tabulated/half_difference_table.hpp"
#include "tabulated/lookup_table.hpp"
#include "tabulated/open.hpp"
#include "tests/bench/synthetic_files.hpp"
#include "tests/bench/thread_clock.hpp"
#include "tests/temporary_folder.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using bench::cpu_seconds;

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr std::size_t side = 128, pairs = side * side, repeats = 64;

struct Pairs {
  std::vector<Direction> wi, wo;
  std::array<std::vector<float>, 3> i, o;

  void add(const Direction& light, const Direction& eye) {
    wi.push_back(light), wo.push_back(eye);
    for (auto [columns, w] : {std::pair(&i, light), std::pair(&o, eye)}) {
      (*columns)[0].push_back(static_cast<float>(w.x()));
      (*columns)[1].push_back(static_cast<float>(w.y()));
      (*columns)[2].push_back(static_cast<float>(w.z()));
    }
  }
};

/// A sphere seen from z, lit from the upper right; each pixel in the frame of its normal, tangent along the picture's rows.
Pairs sphere() {
  Pairs out;
  const std::array<double, 3> light{0.48, 0.6, 0.64};
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t column = 0; column < side; ++column) {
      const auto at = [](std::size_t k) { return (2 * static_cast<double>(k) + 1) / side * 0.7 - 0.7; };  // the inscribed square: no edge
      const double x = at(column), y = at(row), z = std::sqrt(1 - x * x - y * y), t = std::hypot(z, x);
      // Tangent (z, 0, -x)/t, bitangent n x tangent.
      const auto local = [&](const std::array<double, 3>& w) {
        const double along = (z * w[0] - x * w[2]) / t, normal = x * w[0] + y * w[1] + z * w[2];
        const double across = (-x * y * w[0] + (x * x + z * z) * w[1] - y * z * w[2]) / t;
        return Direction::normalized(along, across, normal);
      };
      out.add(local(light), local({0, 0, 1}));
    }
  return out;
}

Pairs scattered() {
  std::mt19937_64 random(20261123);
  std::uniform_real_distribution<double> uniform(0, 1);
  Pairs out;
  const auto draw = [&] {
    const double z = uniform(random), phi = 6.283185307179586 * uniform(random), r = std::sqrt(1 - z * z);
    return Direction::trusted(r * std::cos(phi), r * std::sin(phi), z);
  };
  for (std::size_t k = 0; k < pairs; ++k) {
    const Direction light = draw();
    out.add(light, draw());
  }
  return out;
}

/// Median and least of `runs` timings, in nanoseconds per lookup.
void report(const char* what, int runs, const std::function<void()>& lookups, std::size_t times = repeats) {
  std::vector<double> ns;
  for (int run = 0; run < runs; ++run) {
    const double start = cpu_seconds();
    for (std::size_t k = 0; k < times; ++k) lookups();
    ns.push_back(1e9 * (cpu_seconds() - start) / static_cast<double>(pairs * times));
  }
  std::sort(ns.begin(), ns.end());
  std::printf("  %-44s %7.2f ns (least %.2f)\n", what, ns[ns.size() / 2], ns.front());
}

/// The corners of the same cells in a table of the same shape, read (24 bytes in each of four rows) and added, with nothing else to do: no
/// lookup in a table that keeps each number once can be faster.
class CornersAlone {
 public:
  CornersAlone(const GridShape& shape, const GridCoordinates& at)
      : row_(3 * (shape.count[2] + 1)), plane_(row_ * shape.count[1]), values_(plane_ * shape.count[0] + 8, 1.0f) {
    const auto low = [&](std::size_t axis, std::size_t k, std::size_t most) {
      return std::min(static_cast<std::size_t>(std::max(at.axis[axis][k], 0.0f)), most);
    };
    for (std::size_t k = 0; k < at.size(); ++k)
      first_.push_back(low(0, k, shape.count[0] - 2) * plane_ + low(1, k, shape.count[1] - 2) * row_ + 3 * low(2, k, shape.count[2] - 1));
  }

  void read() {
    typedef float Lanes __attribute__((vector_size(16)));
    std::array<Lanes, 8> sums{};  // no sum waits for another
    for (const std::size_t first : first_) {
      const std::array<std::size_t, 4> rows{first, first + row_, first + plane_, first + plane_ + row_};
      for (std::size_t k = 0; k < sums.size(); ++k) {
        Lanes value;
        std::memcpy(&value, values_.data() + rows[k / 2] + 2 * (k % 2), sizeof value);
        sums[k] += value;
      }
    }
    for (const Lanes& sum : sums) sink_ = sink_ + sum[0];
  }

 private:
  std::size_t row_, plane_;
  LargeArray<float> values_;
  std::vector<std::size_t> first_;
  volatile float sink_ = 0;
};

void time_lookups(const char* order, const Pairs& at, const HalfDifferenceTable& source, const LookupTable& single, const LookupTable& half,
                  int runs) {
  std::printf("%s\n", order);
  const DirectionColumns wi{{at.i[0], at.i[1], at.i[2]}}, wo{{at.o[0], at.o[1], at.o[2]}};
  std::array<std::vector<float>, 3> position;
  for (auto& column : position) column.resize(pairs);
  std::vector<float> f(3 * pairs);
  const auto coordinates = [&] { single.coordinates(wi, wo, {std::span(position[0]), std::span(position[1]), std::span(position[2])}); };
  coordinates();
  const GridCoordinates on_grid{{position[0], position[1], position[2]}};
  CornersAlone corners(single.grid().shape(), on_grid);
  report("directions to coordinates", runs, coordinates);
  report("eight corners only read and added, float", runs, [&] { corners.read(); });
  report("grid, nearest, float", runs, [&] { single.grid().lookup(on_grid, Interpolation::nearest, f); });
  report("grid, trilinear, float", runs, [&] { single.grid().lookup(on_grid, Interpolation::linear, f); });
  report("grid, nearest, half", runs, [&] { half.grid().lookup(on_grid, Interpolation::nearest, f); });
  report("grid, trilinear, half", runs, [&] { half.grid().lookup(on_grid, Interpolation::linear, f); });
  report("from directions, nearest, float", runs, [&] { single.eval(wi, wo, Interpolation::nearest, f); });
  report("from directions, trilinear, float", runs, [&] { single.eval(wi, wo, Interpolation::linear, f); });
  std::vector<double> exact(3 * pairs);
  report(
      "the same in double, planes of the file", runs, [&] { source.eval(at.wi, at.wo, exact); }, 2);
}

/// `cat FILE > /dev/null`, the start of the program included.
double cat_seconds(const std::string& file) {
  std::array<char*, 3> arguments{const_cast<char*>("/bin/cat"), const_cast<char*>(file.c_str()), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const auto start = Clock::now();
  if (posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ) != 0) std::exit(2);
  waitpid(child, nullptr, 0);
  posix_spawn_file_actions_destroy(&actions);
  return seconds_since(start);
}

/// What cat does itself: read() into a buffer, once over.
double plain_read_seconds(const std::string& file) {
  static std::vector<char> buffer(1 << 17);
  const auto start = Clock::now();
  const int in = open(file.c_str(), O_RDONLY);
  while (read(in, buffer.data(), buffer.size()) > 0) continue;
  close(in);
  return seconds_since(start);
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
  const test::TemporaryFolder scratch;
  const std::filesystem::path merl = scratch / "s200.binary";
  bench::write_merl_file(merl, bench::blinn_phong(200));

  std::vector<double> ours, cat, plain;
  for (int run = 0; run < runs; ++run) {
    const auto start = Clock::now();
    const Opened opened = open_brdf(merl);
    ours.push_back(seconds_since(start));
    cat.push_back(cat_seconds(merl.string()));
    plain.push_back(plain_read_seconds(merl.string()));
  }
  const auto median = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  const double mb = static_cast<double>(std::filesystem::file_size(merl)) / 1e6;
  std::printf(
      "reading %.1f MB from the page cache, every number checked: %.2f ms (%.1f GB/s); cat > /dev/null %.2f ms, read() alone %.2f ms; "
      "%.0f %% and %.0f %% of their throughput\n",
      mb, 1e3 * median(ours), mb / 1e3 / median(ours), 1e3 * median(cat), 1e3 * median(plain), 100 * median(cat) / median(ours),
      100 * median(plain) / median(ours));

  const Opened opened = open_brdf(merl);
  const auto source = std::dynamic_pointer_cast<const HalfDifferenceTable>(opened.brdf);
  const auto start = Clock::now();
  const LookupTable single(*source, merl_layout(NodeRule::centre), Storage::f32, 2);
  std::printf("table of 90 x 90 x 180 nodes made in %.2f s: %.1f MB as float", seconds_since(start),
              static_cast<double>(single.grid().bytes()) / 1e6);
  const LookupTable half(*source, merl_layout(NodeRule::centre), Storage::f16, 2);
  std::printf(", %.1f MB as half\n", static_cast<double>(half.grid().bytes()) / 1e6);
  time_lookups("picture of a sphere", sphere(), *source, single, half, runs);
  time_lookups("random pairs", scattered(), *source, single, half, runs);
  return 0;
}
