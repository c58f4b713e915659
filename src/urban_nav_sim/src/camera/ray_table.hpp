// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "camera/lens.hpp"

namespace urban_nav_sim {

/// Ray of each pixel of a lens: (x, y, 1) in camera axes, so that distances along it are depths. Immutable, hence
/// thread-safe.
class RayTable {
 public:
  /// Throws UserError if a pixel of the image has no ray.
  explicit RayTable(const Lens& lens);

  int width() const { return width_; }
  int height() const { return height_; }
  /// 0 <= u <= width, 0 <= v <= height: one column and row more than the image, for differences.
  const Eigen::Vector2f& at(int u, int v) const {
    return ideal_[static_cast<std::size_t>(v) * stride_ + static_cast<std::size_t>(u)];
  }
  /// Return the differences to the pixel on the right, and below. Require a pixel within the image.
  Eigen::Vector2f right(int u, int v) const { return at(u + 1, v) - at(u, v); }
  Eigen::Vector2f down(int u, int v) const { return at(u, v + 1) - at(u, v); }

 private:
  int width_, height_;
  std::size_t stride_;
  std::vector<Eigen::Vector2f> ideal_;
};

}  // namespace urban_nav_sim
