// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/opened_samples.hpp"

#include <utility>

#include "brdf/error.hpp"
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

Opened opened_table(std::string format, std::shared_ptr<const LatticeTable> table, const std::string& file) {
  auto samples = std::make_shared<Dataset>(table->samples());
  if (samples->size() == 0) throw Error(ErrorKind::input, {file, "no value above the horizon", "at least one"});
  Opened out = opened_samples(std::move(format), std::move(samples));
  out.brdf = std::move(table);
  return out;
}

}  // namespace gonio::tabulated
