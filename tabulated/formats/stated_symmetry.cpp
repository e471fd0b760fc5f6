// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/stated_symmetry.hpp"

#include <fmt/format.h>

#include "brdf/error.hpp"

namespace gonio::tabulated {

Symmetry stated_symmetry(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string answer = options.assumed("isotropic").value_or("no");
  if (answer != "yes" && answer != "no")
    throw Error(ErrorKind::input, {path.string(), fmt::format("--assume isotropic={}", answer), "yes or no"});
  return {.isotropic = answer == "yes"};
}

}  // namespace gonio::tabulated
