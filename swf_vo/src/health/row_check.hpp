// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "urban_nav_core/image/fast.hpp"
#include "urban_nav_core/image/patch.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

/// Matching points of both images, to whole pixels.
struct RowMatch {
  Eigen::Vector2d left = Eigen::Vector2d::Zero(), right = Eigen::Vector2d::Zero();
};

/// Measures the row disagreement of a pair that should be rectified: corners spread over the left image are searched in
/// the right image along and across rows, and must be matched back. For pairs that cannot be matched along rows. Not
/// thread-safe.
class RowCheck {
 public:
  /// Returns the median row difference of matching points (px, up to 24) after subtraction of the known offset
  /// `row_offset_px` of the right image. Empty with fewer than 15 matches. Requires images of equal size.
  std::optional<double> measure(const urban_nav_core::StereoPair& pair, double row_offset_px = 0.0);

  /// Measures the first of these pairs and every 20th after it, and returns the last result: the mounting of cameras
  /// does not change from frame to frame, and a measurement takes about as long as the odometry of a frame.
  std::optional<double> measureSometimes(const urban_nav_core::StereoPair& pair, double row_offset_px = 0.0);
  /// Returns the matching points of the last pair if measureSometimes() measured it; empty otherwise.
  const std::vector<RowMatch>& matches() const { return matches_; }
  /// Forgets the last result: the next pair of measureSometimes() is measured.
  void reset();
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Place {
    int sad = std::numeric_limits<int>::max(), second = std::numeric_limits<int>::max();  ///< grey levels
    int u = 0, v = 0;
  };
  Place search(const urban_nav_core::SadPatch& patch, const urban_nav_core::ImageView& image, int first, int last,
               int v);

  int pairs_until_next_ = 0;
  std::optional<double> last_;
  urban_nav_core::Fast fast_;
  std::vector<urban_nav_core::Corner> strongest_;  // strongest corners of the cells
  std::vector<int> costs_;
  std::vector<double> differences_;
  std::vector<RowMatch> matches_;
};

}  // namespace swf_vo
