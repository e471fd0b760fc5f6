// SPDX-License-Identifier: BSD-3-Clause
// What a reader refused, as one text to search in.
#pragma once

#include <fmt/format.h>

#include <string>

#include "brdf/error.hpp"

namespace gonio::test {

/// Every fault in one text, or "" if nothing was thrown.
template <class Action>
std::string faults_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    std::string out = fmt::format("{}|", name(error.kind()));
    for (const Fault& fault : error.faults()) out += fmt::format("{}|{}|{}\n", fault.where, fault.found, fault.wanted);
    return out;
  }
  return "";
}

}  // namespace gonio::test
