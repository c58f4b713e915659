// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace urban_nav_core {

/// Quadtree that distributes features over the image (Newman et al. 2009, section 2.4 (v)): each node counts the
/// measurements in its part of the image, up to a limit. A pixel has room if every node that contains it has.
///
/// Depth 0 is the whole image; depth d has 2^d x 2^d equal parts, each allowed min(most, ceil(slack most / 4^d))
/// measurements: slack 1 forces an even spread, larger values let one part have more than its share. All memory is
/// taken by the constructor. Not thread-safe.
class FeatureQuadtree {
 public:
  /// An image of width x height px, at most `most` >= 1 measurements, depths 0...deepest (0...10), slack >= 1.
  FeatureQuadtree(int width, int height, int most, int deepest, double slack);

  void clear();

  /// Is there room for one more at (u, v)? Never outside the image.
  bool mayAdd(double u, double v) const;
  /// Counts a measurement, room or not (what is tracked already is not turned away). Outside the image: no effect.
  void add(double u, double v);
  /// Takes back one that was added at this place.
  void remove(double u, double v);

  int count() const { return counts_[0]; }
  int deepest() const { return deepest_; }
  /// Counted in and allowed for the node of this depth that holds (u, v), a place in the image.
  int countAt(double u, double v, int depth) const { return counts_[index(u, v, depth)]; }
  int allowedAt(int depth) const { return allowed_[static_cast<std::size_t>(depth)]; }

 private:
  bool isInside(double u, double v) const;
  std::size_t index(double u, double v, int depth) const;

  int width_, height_;
  int deepest_;
  std::vector<int> allowed_;  ///< per depth
  std::vector<int> counts_;   ///< of the nodes, depth by depth, row by row
};

}  // namespace urban_nav_core
