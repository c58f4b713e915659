// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "padded.hpp"

namespace dense_stereo {

/// Removes small patches: 8-connected components of pixels whose disparities differ by at most one between neighbours.
/// Keeps its buffers. Not thread-safe.
class SmallComponents {
 public:
  /// Invalidates (65535) components of fewer than `least` pixels.
  void remove(Padded<std::uint16_t>& disparity, int least);

 private:
  void labelRow(const Padded<std::uint16_t>& disparity, int v);
  std::int32_t find(std::int32_t label);
  std::int32_t join(std::int32_t a, std::int32_t b);

  Padded<std::int32_t> labels_;  ///< -1 for invalid pixels
  std::int32_t count_ = 0;       ///< labels in use
  std::vector<std::int32_t> parents_, sizes_;
};

}  // namespace dense_stereo
