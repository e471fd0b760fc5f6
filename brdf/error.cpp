// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/error.hpp"

#include <utility>

namespace gonio {
namespace {

std::string sentence(const Fault& fault) {
  std::string text = fault.where;
  if (!fault.found.empty()) text += (text.empty() ? "found " : ": found ") + fault.found;
  if (!fault.wanted.empty()) text += (text.empty() ? "wanted " : ", wanted ") + fault.wanted;
  return text;
}

}  // namespace

Error::Error(ErrorKind kind, std::string message, std::vector<Fault> faults)
    : kind_(kind), message_(std::move(message)), faults_(std::move(faults)), what_(message_) {
  for (const Fault& fault : faults_) what_ += "\n  " + sentence(fault);
}

Error::Error(ErrorKind kind, Fault fault) : kind_(kind), message_(sentence(fault)), faults_{std::move(fault)}, what_(message_) {}

const char* name(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::usage: return "usage";
    case ErrorKind::input: return "input";
    case ErrorKind::limit: return "limit";
    case ErrorKind::device: return "device";
    case ErrorKind::interrupted: return "interrupted";
    case ErrorKind::internal: return "internal";
  }
  return "internal";
}

}  // namespace gonio
