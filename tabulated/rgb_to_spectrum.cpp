// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/rgb_to_spectrum.hpp"

namespace gonio::tabulated {
namespace {

using Spectrum = std::array<double, PrimarySpectra::count>;

/// The solution of the quadratic programme, to seven digits.
constexpr Spectrum red{0.0249441, 0.0249434, 0.0249392, 0.0249244, 0.0248707, 0.0246497, 0.0238924, 0.0218531, 0.0189129, 0.0191515,
                       0.0318312, 0.0127678, 0,         0,         0,         0,         0,         0,         0,         0,
                       0,         0.0222592, 0.2109806, 0.4765101, 0.7337266, 0.9190976, 1,         1,         1,         1,
                       1,         1,         1,         1,         1,         1,         1,         1,         1,         1,
                       1,         1,         1,         1,         1,         1,         1,         1};
constexpr Spectrum blue{0.9750559, 0.9750566, 0.9750608, 0.9750756, 0.9751293, 0.9753503, 0.9761076, 0.9781469, 0.9810871, 0.9808485,
                        0.9681688, 0.8718545, 0.6995037, 0.4904465, 0.2866627, 0.1178902, 0.014112,  0,         0,         0,
                        0,         0.0455051, 0.0511593, 0.0346431, 0.0132708, 0,         0,         0,         0,         0,
                        0,         0,         0,         0,         0,         0,         0,         0,         0,         0,
                        0,         0,         0,         0,         0,         0,         0,         0};

/// What red and blue leave of 1.
constexpr Spectrum green = [] {
  Spectrum out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = 1 - red[k] - blue[k];
  return out;
}();

constexpr std::array<Spectrum, 3> primaries{red, green, blue};

}  // namespace

const std::array<Spectrum, 3>& PrimarySpectra::values() { return primaries; }

}  // namespace gonio::tabulated
