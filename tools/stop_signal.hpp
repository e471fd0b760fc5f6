// SPDX-License-Identifier: BSD-3-Clause
// SIGINT and SIGTERM as a flag.
#pragma once

#include <atomic>

namespace gonio::tools {

/// Installs the handlers once; the flag becomes true at the first signal. A second one ends the process at once, as usual.
const std::atomic<bool>& stop_on_signals();

}  // namespace gonio::tools
