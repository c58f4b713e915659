// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "urban_nav_core/image/corner.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// How many corners a cell of the image may give, so that dark or smooth parts still give some and busy ones do not
/// explode: those above `threshold`; where they are fewer than `least`, the best `least` of all that were detected (at
/// the lower threshold of Fast::detect); where they are more than `most`, the best `most`. Best is by score of FAST, of
/// equal scores the first in reading order: the same on every machine.
struct CornerQuota {
  int cell = 32;       ///< px, side of a cell
  int threshold = 20;  ///< grey levels
  int least = 2;
  int most = 24;
};

/// The corners of one image, ordered by square cells so that those about a place are found at once.
/// Not thread-safe while it is filled; allocates only while its buffers grow.
class CornerGrid {
 public:
  /// `cell`: side of the cells in px, about the usual search radius.
  explicit CornerGrid(int cell = 16);

  /// Takes the corners of an image of this size; order in: any; order inside: by cell, cells in reading order, within a
  /// cell as they came.
  void assign(const std::vector<Corner>& corners, int width, int height);

  const std::vector<Corner>& corners() const { return corners_; }
  std::size_t size() const { return corners_.size(); }

  /// Calls visit(corner, index into corners()) for all corners within `radius` of (u, v), borders included, in a
  /// fixed order.
  template <typename Visit>
  void forEachWithin(double u, double v, double radius, Visit visit) const {
    forEachInside(u - radius, v - radius, u + radius, v + radius, [&](const Corner& corner, std::size_t index) {
      const double du = corner.u - u, dv = corner.v - v;
      if (du * du + dv * dv <= radius * radius) visit(corner, index);
    });
  }

  /// The same for a rectangle: u_min <= u <= u_max, v_min <= v <= v_max; for the band of rows of a stereo search.
  template <typename Visit>
  void forEachInside(double u_min, double v_min, double u_max, double v_max, Visit visit) const {
    if (corners_.empty() || !(u_max >= 0.0 && v_max >= 0.0 && u_min <= width_ && v_min <= height_)) return;
    const int first_column = toCell(u_min, columns_), last_column = toCell(u_max, columns_);
    const int first_row = toCell(v_min, rows_), last_row = toCell(v_max, rows_);
    for (int row = first_row; row <= last_row; ++row) {
      // Cells of one row follow each other, so do their corners.
      const std::size_t begin = starts_[static_cast<std::size_t>(row * columns_ + first_column)];
      const std::size_t end = starts_[static_cast<std::size_t>(row * columns_ + last_column + 1)];
      for (std::size_t i = begin; i < end; ++i) {
        const Corner& corner = corners_[i];
        if (corner.u >= u_min && corner.u <= u_max && corner.v >= v_min && corner.v <= v_max) visit(corner, i);
      }
    }
  }

 private:
  int toCell(double coordinate, int cells) const {
    return static_cast<int>(std::clamp(coordinate, 0.0, static_cast<double>(cells * cell_) - 1.0)) / cell_;
  }

  int cell_;
  int width_ = 0, height_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<Corner> corners_;
  std::vector<std::size_t> starts_;  ///< of each cell in corners_, one more for the end
};

/// Keeps what the quota allows, in the order it had. Not thread-safe; allocates only while its buffers grow.
class CornerCap {
 public:
  explicit CornerCap(const CornerQuota& quota) : quota_(quota) {}
  void apply(std::vector<Corner>& corners, int width, int height);

 private:
  CornerQuota quota_;
  std::vector<int> histograms_;  ///< of scores, 256 per cell
  std::vector<int> limits_;      ///< per cell: the lowest score that may stay
  std::vector<int> room_;        ///< per cell: how many of that score
};

}  // namespace urban_nav_core
