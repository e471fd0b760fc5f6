// SPDX-License-Identifier: BSD-3-Clause
// How long a fit takes as a whole process: bench_figures GONIO [RUNS] writes its files into a temporary folder, fits each of them with
// --json (so that hashing counts), and prints medians with the memory, beside a plain sum over the same mapping.
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "fitting/fit.hpp"
#include "tabulated/mapped_file.hpp"
#include "tabulated/open.hpp"
#include "tests/bench/synthetic_files.hpp"
#include "tests/temporary_folder.hpp"

using namespace gonio;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Seconds of several runs in milliseconds: the median and, since other programs may take their share of the machine, the least.
std::string milliseconds(const std::vector<double>& seconds) {
  return fmt::format("{:.1f} (least {:.1f})", 1e3 * median(seconds), 1e3 * *std::min_element(seconds.begin(), seconds.end()));
}

struct Run {
  double wall_s = 0, memory_mb = 0;
  Json document;
};

/// One process from its start to its end, standard output to a file.
Run run(const std::vector<std::string>& command, const std::filesystem::path& out) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const auto start = Clock::now();
  pid_t child = 0;
  if (posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ) != 0) {
    std::fprintf(stderr, "cannot start %s\n", arguments[0]);
    std::exit(2);
  }
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  Run out_run;
  out_run.wall_s = seconds_since(start);
  out_run.memory_mb = static_cast<double>(used.ru_maxrss) / 1024;
  out_run.document = parse_json(gonio::read_file(out), out.string());
  return out_run;
}

/// The sum of every double of a mapping on two threads: what any pass over the table costs at least.
std::vector<double> plain_sum_s(const std::filesystem::path& path, int runs) {
  const tabulated::MappedFile file(path);
  const std::byte* const first = file.bytes().data() + 12;
  const std::size_t count = (file.bytes().size() - 12) / sizeof(double);
  std::vector<double> seconds;
  volatile double sink = 0;
  for (int k = 0; k < runs; ++k) {
    const auto start = Clock::now();
    double sums[2] = {};
    const auto sum = [&](std::size_t part) {
      double lanes[8] = {};
      double values[512];
      const std::size_t begin = part * (count / 2) / 512 * 512, end = part == 0 ? count / 2 / 512 * 512 : count / 512 * 512;
      for (std::size_t j = begin; j < end; j += 512) {
        std::memcpy(values, first + j * sizeof(double), sizeof values);
        for (std::size_t i = 0; i < 512; ++i) lanes[i % 8] += values[i];
      }
      for (const double lane : lanes) sums[part] += lane;
    };
    {
      const std::jthread other([&] { sum(1); });
      sum(0);
    }
    sink = sink + sums[0] + sums[1];
    seconds.push_back(seconds_since(start));
  }
  return seconds;
}

/// Collapse, weights, scan and intervals on two threads, of a table that is mapped already: the fit without what the program does beside
/// it.
std::vector<double> fit_alone_s(const std::filesystem::path& path, int runs) {
  const tabulated::Opened opened = tabulated::open_brdf(path.string(), {});
  fitting::FitOptions options;
  options.model = "blinn-phong-ngan";
  options.threads = 2;
  std::vector<double> seconds;
  for (int k = -1; k < runs; ++k) {
    const fitting::StageTimes stages = fitting::fit(*opened.observations, options).stages;
    if (k >= 0) seconds.push_back(stages.collapse_s + stages.weights_s + stages.scan_s + stages.intervals_s);
  }
  return seconds;
}

void report(const std::string& gonio, const std::filesystem::path& file, const std::string& model, int runs) {
  std::vector<double> wall, memory, estimate;
  std::map<std::string, std::vector<double>> inside;
  Json last;
  std::filesystem::path out = file;
  out += ".out";
  for (int k = -1; k < runs; ++k) {
    Run one = run({gonio, "fit", file.string(), "--model", model, "--json"}, out);
    last = std::move(one.document);
    if (k < 0) continue;  // the first fills the page cache
    wall.push_back(one.wall_s), memory.push_back(one.memory_mb);
    for (const auto& [name, value] : last.at("timings_s").members()) inside[name].push_back(value.number());
    estimate.push_back(0);
    for (const char* stage : {"collapse", "weights", "scan", "intervals"}) estimate.back() += inside[stage].back();
  }
  std::string fitted, times;
  for (const Json& parameter : last.at("parameters").elements())
    fitted += fmt::format(" {}={:.5g}", parameter.at("name").string(), parameter.at("value").number());
  for (const auto& [name, seconds] : inside) times += fmt::format(", {} {}", name, milliseconds(seconds));
  const std::string title = file.filename().string();
  fmt::print("{:<16} wall {} ms, {:.0f} MB;{}\n", title, milliseconds(wall), median(memory), fitted);
  fmt::print("{:<16} collapse, weights, scan and intervals {} ms; inside{}\n", "", milliseconds(estimate), times);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_figures PATH_OF_GONIO [RUNS]\n");
    return 2;
  }
  const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 11;
  const test::TemporaryFolder folder;
  for (const double s : {50.0, 2000.0, 20000.0}) {
    const auto merl = folder / fmt::format("s{}.binary", s), csv = folder / fmt::format("s{}.csv", s);
    bench::write_merl_file(merl, bench::blinn_phong(s));
    bench::write_csv_file(csv, bench::blinn_phong(s));
    report(argv[1], merl, "blinn-phong-ngan", runs);
    fmt::print("{:<16} the same without the hash beside it {} ms, plain sum of the mapping {} ms, 2 threads each\n", "",
               milliseconds(fit_alone_s(merl, runs)), milliseconds(plain_sum_s(merl, runs)));
    report(argv[1], csv, "blinn-phong-ngan", runs);
    std::filesystem::remove(merl);
  }
  for (const double alpha : {0.02, 0.1, 0.4}) {
    constexpr double five_degrees = 0.087;  // 1.0 million samples
    const auto merl = folder / fmt::format("alpha{}.binary", alpha);
    bench::write_merl_file(merl, bench::ggx(alpha), five_degrees);
    report(argv[1], merl, "ggx", runs);
    std::filesystem::remove(merl);
  }
  return 0;
}
