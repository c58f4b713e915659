// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "padded.hpp"

namespace dense_stereo {

/// Marks the pixels within a window of 9x9 of a depth edge: two neighbours in a row or column, with at most eight
/// invalid pixels between them, whose disparities differ by more than a slanted surface explains. Keeps its buffers.
/// Not thread-safe.
class DepthEdges {
 public:
  static constexpr int kRadius = 4;  ///< px
  /// `disparity`: px, 65535 for invalid. `edges`: 255 near an edge, else 0.
  void mark(const Padded<std::uint16_t>& disparity, Padded<std::uint8_t>& edges);

 private:
  std::vector<std::uint16_t> last_;  ///< per column: the last valid disparity
  std::vector<std::uint8_t> age_;    ///< rows since then
  Padded<std::uint8_t> wide_;        ///< marks, dilated along rows
};

}  // namespace dense_stereo
