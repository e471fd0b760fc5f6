// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/fault_list.hpp"

#include <fmt/format.h>

#include <utility>

namespace gonio::tabulated {

void FaultList::add(std::string where, std::string found, std::string wanted) {
  if (++count_ <= shown) faults_.push_back({std::move(where), std::move(found), std::move(wanted)});
}

void FaultList::add_at(std::size_t line, std::string found, std::string wanted) {
  add(fmt::format("{}:{}", file_, line), std::move(found), std::move(wanted));
}

void FaultList::raise() const {
  if (empty()) return;
  std::vector<Fault> faults = faults_;
  if (count_ > shown) faults.push_back({fmt::format("{}: {} more faults", file_, count_ - shown), "", ""});
  if (faults.size() == 1) throw Error(ErrorKind::input, faults.front());
  throw Error(ErrorKind::input, fmt::format("{} cannot be used: {} faults", file_, count_), faults);
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string out = "'";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f)
      out += c;
    else
      out += fmt::format("\\x{:02x}", byte);
  }
  return out + (text.size() > longest ? "...'" : "'");
}

}  // namespace gonio::tabulated
