// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/sheet_side.hpp"

namespace gonio::tabulated {

std::string SheetSide::name() const {
  return std::string(kind == Side::reflection ? "Reflection" : "Transmission") + (front ? " Front" : " Back");
}

}  // namespace gonio::tabulated
