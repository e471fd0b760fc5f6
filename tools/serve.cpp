// SPDX-License-Identifier: BSD-3-Clause
// gonio serve: emulate a bench's devices until stopped.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <optional>

#include <poll.h>

#include "acquisition/simulated/simulated_bench.hpp"
#include "tools/bench_source.hpp"
#include "tools/stop_signal.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {

using namespace gonio::acquisition;

int serve_verb(const Arguments& arguments, Console& console) {
  CLI::App app(
      "Emulates the drives (Modbus TCP) and the power meter (SCPI) of a bench on loopback until stopped. Prints one line\n"
      "{\"ready\":true,\"modbus\":PORT,\"scpi\":PORT}. The ports are those of the bench file, or any free ones.",
      "serve");
  std::string path, clock_name = "real", sample;
  std::vector<std::string> parameters;
  std::optional<std::uint64_t> seed;
  app.add_option("BENCH", path, "Bench file (JSON)")->required();
  app.add_option("--clock", clock_name, "real (default), or virtual: time moves only as the client sleeps")
      ->check(CLI::IsMember({"real", "virtual"}));
  app.add_option("--sample", sample, "A model's name or a BRDF file instead of the bench file's sample");
  app.add_option("--param", parameters, "NAME=VALUE of the sample's model")->take_all();
  app.add_option("--seed", seed, "Another seed than the bench file's");
  add_common(app, console);
  if (!parse(app, arguments)) return 0;

  const Bench bench = bench_with_seed(path, seed);
  if (!bench.is_simulated) throw Error(ErrorKind::input, {path, "a bench that is not simulated", "a bench file with a `simulated` part"});
  const auto brdf = simulated_sample(bench, path, sample, parameters);
  std::shared_ptr<Clock> clock;
  if (clock_name == "virtual")
    clock = std::make_shared<VirtualClock>();
  else
    clock = std::make_shared<RealClock>();
  const std::atomic<bool>& stop = stop_on_signals();
  simulated::SimulatedBench devices(bench, brdf, clock);
  const auto ports = devices.ports();
  console.print(Json::object({{"ready", true}, {"modbus", ports.modbus}, {"scpi", ports.scpi}}).dump(-1));
  std::cout.flush();
  // A signal interrupts the wait; the time-out only covers one that came just before it.
  while (!stop.load()) poll(nullptr, 0, 200);
  devices.stop();
  return 0;
}

}  // namespace gonio::tools
