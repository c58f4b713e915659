// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "padded.hpp"

namespace dense_stereo {

/// Laplacian of Gaussian (Marr and Hildreth 1980): binomial smoothing over 5x5 pixels, then the sum of the four
/// neighbours minus four times the pixel. It removes differences in exposure. Result: 128 plus four times that, limited
/// to 65...191. Keeps its buffers.
class LogFilter {
 public:
  /// Rows of both images must be extended by extendRows(), as are those of the result.
  void apply(const Padded<std::uint8_t>& image, Padded<std::uint8_t>& filtered);

 private:
  Padded<std::uint16_t> smooth_;       ///< 256 times a grey level
  std::vector<std::uint16_t> column_;  ///< one row, smoothed down the columns
};

}  // namespace dense_stereo
