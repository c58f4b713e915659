// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace urban_nav_core {

/// Quadtree that distributes features over the image (Newman et al. 2009, section 2.4 (v)): each node counts the
/// measurements in its part of the image, up to a limit. A feature may be added if no node that contains it is full.
///
/// Depth 0 is the whole image; depth d has 2^d x 2^d equal parts, each with a limit of min(most, ceil(slack most /
/// 4^d)) measurements: slack 1 enforces an even distribution, larger values let a part exceed its share. The
/// constructor allocates all memory. Not thread-safe.
class FeatureQuadtree {
 public:
  /// `width` x `height`: image size, px. `most` >= 1: limit for the whole image. `deepest`: 0...10. `slack` >= 1.
  FeatureQuadtree(int width, int height, int most, int deepest, double slack);

  void clear();

  /// Returns whether one more measurement fits at (u, v). False outside the image.
  bool mayAdd(double u, double v) const;
  /// Counts a measurement, also in full nodes (tracked features are always kept). No effect outside the image.
  void add(double u, double v);
  /// Removes a measurement that was added at this position.
  void remove(double u, double v);

  int count() const { return counts_[0]; }
  int deepest() const { return deepest_; }
  /// Return the count and the limit of the node at this depth that contains (u, v), which must be in the image.
  int countAt(double u, double v, int depth) const { return counts_[index(u, v, depth)]; }
  int allowedAt(int depth) const { return allowed_[static_cast<std::size_t>(depth)]; }

 private:
  bool isInside(double u, double v) const;
  std::size_t index(double u, double v, int depth) const;

  int width_, height_;
  int deepest_;
  std::vector<int> allowed_;  ///< per depth
  std::vector<int> counts_;   ///< per node: depth by depth, row by row
};

}  // namespace urban_nav_core
