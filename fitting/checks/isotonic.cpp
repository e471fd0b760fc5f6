// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/isotonic.hpp"

#include <cstddef>

namespace gonio::fitting {

std::vector<double> non_increasing(const std::vector<double>& values, const std::vector<double>& weights) {
  struct Pool {
    double mean, weight;
    std::size_t count;
  };
  std::vector<Pool> pools;
  for (std::size_t k = 0; k < values.size(); ++k) {
    pools.push_back({values[k], weights[k], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean < pools.back().mean) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& pool = pools.back();
      pool.mean = (pool.mean * pool.weight + last.mean * last.weight) / (pool.weight + last.weight);
      pool.weight += last.weight;
      pool.count += last.count;
    }
  }
  std::vector<double> out;
  for (const Pool& pool : pools) out.insert(out.end(), pool.count, pool.mean);
  return out;
}

}  // namespace gonio::fitting
