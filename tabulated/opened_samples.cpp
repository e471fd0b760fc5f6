// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/opened_samples.hpp"

#include <utility>

#include "tabulated/describe.hpp"
#include "tabulated/direction_table.hpp"

namespace gonio::tabulated {

Opened opened_samples(std::string format, std::shared_ptr<const Dataset> dataset) {
  Opened out;
  out.format = std::move(format);
  out.observations = observe(dataset);
  out.brdf = std::make_shared<const DirectionTable>(dataset);
  out.info = describe(*dataset);
  out.masked = dataset->masked;
  out.simulated = dataset->simulated;
  out.side = dataset->side;
  out.dataset = std::move(dataset);
  return out;
}

}  // namespace gonio::tabulated
