// SPDX-License-Identifier: BSD-3-Clause
// One parameter of a fit by its name.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "fitting/fit.hpp"

namespace gonio::test {

/// Of a channel, or shared by all. Throws std::out_of_range if there is none.
inline const fitting::FittedParameter& parameter(const fitting::FitResult& result, const std::string& name, std::size_t channel = 0) {
  for (const fitting::FittedParameter& p : result.parameters)
    if (p.name == name && p.channel.value_or(channel) == channel) return p;
  throw std::out_of_range(name);
}

}  // namespace gonio::test
