// SPDX-License-Identifier: BSD-3-Clause
// A loop over independent pieces of work on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace gonio::tabulated {

/// Calls `body(k)` once for every k below `count` on `threads` threads (at least one: the caller's), in no order. The first exception
/// stops what has not begun and comes back to the caller.
void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace gonio::tabulated
