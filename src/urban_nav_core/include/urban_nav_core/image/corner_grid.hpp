// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "urban_nav_core/image/corner.hpp"
#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Number of corners per cell of the image, so that dark or smooth regions keep some and textured ones are limited. All
/// corners above `threshold` are kept; if there are fewer than `least`, the best `least` of all detected ones (at the
/// lower threshold of Fast::detect); if there are more than `most`, the best `most`. Best means the highest FAST score,
/// ties in reading order, so that the result is the same on every machine.
struct CornerQuota {
  int cell = 32;       ///< px, side of a cell
  int threshold = 20;  ///< grey levels
  int least = 2;
  int most = 24;
};

/// Corners of one image, ordered by square cells for queries by position. Not thread-safe while it is filled. Allocates
/// only while its buffers grow.
class CornerGrid {
 public:
  /// `cell`: side of the cells in px, about the usual search radius.
  explicit CornerGrid(int cell = 16);

  /// Stores the corners of an image of this size, given in any order. Stored order: by cell, cells in reading order,
  /// within a cell as given.
  void assign(const std::vector<Corner>& corners, int width, int height);

  const std::vector<Corner>& corners() const { return corners_; }
  std::size_t size() const { return corners_.size(); }

  /// Calls visit(corner, index into corners()) for all corners within `radius` of (u, v), inclusive, in a fixed order.
  template <typename Visit>
  void forEachWithin(double u, double v, double radius, Visit visit) const {
    forEachInside(u - radius, v - radius, u + radius, v + radius, [&](const Corner& corner, std::size_t index) {
      const double du = corner.u - u, dv = corner.v - v;
      if (du * du + dv * dv <= radius * radius) visit(corner, index);
    });
  }

  /// Calls visit(corner, index into corners()) for all corners with u_min <= u <= u_max, v_min <= v <= v_max, in a
  /// fixed order; for the row band of a stereo search.
  template <typename Visit>
  void forEachInside(double u_min, double v_min, double u_max, double v_max, Visit visit) const {
    if (corners_.empty() || !(u_max >= 0.0 && v_max >= 0.0 && u_min <= width_ && v_min <= height_)) return;
    const int first_column = toCell(u_min, columns_), last_column = toCell(u_max, columns_);
    const int first_row = toCell(v_min, rows_), last_row = toCell(v_max, rows_);
    for (int row = first_row; row <= last_row; ++row) {
      // Cells of one row are contiguous, hence so are their corners.
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
  std::vector<std::size_t> starts_;  ///< first corner of each cell in corners_, and the end
};

/// Selects corners by CornerQuota, in the order given. Not thread-safe; allocates only while its buffers grow.
class CornerCap {
 public:
  explicit CornerCap(const CornerQuota& quota) : quota_(quota) {}
  void apply(std::vector<Corner>& corners, int width, int height);

 private:
  CornerQuota quota_;
  std::vector<int> histograms_;  ///< of scores, 256 per cell
  std::vector<int> limits_;      ///< per cell: the lowest score that is kept
  std::vector<int> room_;        ///< per cell: remaining number of corners with that score
};

}  // namespace urban_nav_core
