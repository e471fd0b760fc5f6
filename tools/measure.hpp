// SPDX-License-Identifier: BSD-3-Clause
// Running a sweep as the verbs `sweep` and `demo` do it: against the embedded simulated bench or devices on the network.
#pragma once

#include <memory>
#include <string>

#include "acquisition/run.hpp"
#include "acquisition/sweep.hpp"
#include "brdf/brdf.hpp"
#include "tools/console.hpp"

namespace gonio::tools {

enum class ClockChoice { bench, real, virtual_time };  ///< bench: virtual when embedded, what the server owns otherwise

/// Measures what the run still lacks. `sample` is needed only if the bench is simulated and names no port: then it is embedded.
/// SIGINT and SIGTERM stop the arms and end with Error(interrupted); the run file stays sound.
acquisition::SweepResult measure(acquisition::Run& run, const acquisition::Bench& bench, std::shared_ptr<const Brdf> sample,
                                 ClockChoice clock, const Console& console);

/// True if the bench's devices are emulated inside this process.
bool is_embedded(const acquisition::Bench& bench);

}  // namespace gonio::tools
