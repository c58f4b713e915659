// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/image/corner.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// FAST-9/16 (Rosten and Drummond 2006): a pixel is a corner at threshold t if nine neighbouring pixels of the circle
/// of sixteen around it are all brighter than it by more than t grey levels, or all darker. Its score is the smallest
/// threshold at which it is one no more; so the corners at a higher threshold are those with score > threshold, and
/// one pass at the lowest threshold of interest serves all (corner_grid.hpp chooses among them).
///
/// Own code because cv::FAST allocates and computes the score one corner at a time; here sixteen pixels go together.
/// Not thread-safe; allocates only while its buffers grow.
class Fast {
 public:
  static constexpr int kRadius = 3;  ///< px; nearer to the border there are no corners

  enum class Suppression {
    None,
    /// Kept if no neighbour of the eight has a higher score; of neighbours with equal scores the first in reading
    /// order stays.
    LocalMaximum,
  };

  /// Corners of the image in reading order; threshold 0...254. The result lives until the next call.
  const std::vector<Corner>& detect(const ImageView& image, int threshold, Suppression suppression);

 private:
  std::vector<Corner> corners_;
  std::vector<std::uint8_t> scores_;  ///< of three successive rows
};

}  // namespace urban_nav_core
