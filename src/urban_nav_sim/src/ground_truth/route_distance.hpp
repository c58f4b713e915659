// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "motion/motion.hpp"

namespace urban_nav_sim {

/// Grid of the ground plan near the path of a motion, for queries of millions of points. Immutable, hence thread-safe.
class RouteDistance {
 public:
  /// `radius`: m, accurate to half a cell, 0.25 m.
  RouteDistance(const Motion& motion, double radius);

  bool has(float x, float y) const {
    const int i = cellIndex(x - low_.x()), j = cellIndex(y - low_.y());
    return i >= 0 && j >= 0 && i < columns_ && j < rows_ && near_[static_cast<std::size_t>(j * columns_ + i)];
  }
  /// Returns false only if no part of the rectangle is near.
  bool touches(const Eigen::Vector2f& low, const Eigen::Vector2f& high) const;

 private:
  static int cellIndex(float metres);
  void mark(const Eigen::Vector2d& place, double radius);

  Eigen::Vector2f low_;
  int columns_ = 0, rows_ = 0;
  std::vector<bool> near_;
};

}  // namespace urban_nav_sim
