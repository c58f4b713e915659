// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/image/corner.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// FAST-9/16 (Rosten and Drummond 2006): a pixel is a corner at threshold t if nine contiguous pixels on the circle of
/// sixteen around it are all brighter by more than t grey levels, or all darker. Its score is the smallest threshold at
/// which it is no longer a corner. The corners at a higher threshold are therefore those with score > threshold, and
/// one pass at the lowest threshold is sufficient (corner_grid.hpp selects among them).
///
/// Own code because cv::FAST allocates and computes scores one corner at a time; this one processes sixteen pixels at
/// once. Not thread-safe; allocates only while its buffers grow.
class Fast {
 public:
  static constexpr int kRadius = 3;  ///< px; no corners nearer to the border

  enum class Suppression {
    None,
    /// Keeps corners without a higher score among their eight neighbours; of neighbours with equal scores the first in
    /// reading order.
    LocalMaximum,
  };

  /// Returns the corners of the image in reading order; threshold 0...254. Valid until the next call.
  const std::vector<Corner>& detect(const ImageView& image, int threshold, Suppression suppression);

 private:
  std::vector<Corner> corners_;
  std::vector<std::uint8_t> scores_;  ///< scores of three successive rows
};

}  // namespace urban_nav_core
