// SPDX-License-Identifier: BSD-3-Clause
#include "camera/ray_table.hpp"

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

RayTable::RayTable(const Lens& lens)
    : width_(lens.width), height_(lens.height), stride_(static_cast<std::size_t>(lens.width) + 1) {
  ideal_.reserve(stride_ * (static_cast<std::size_t>(lens.height) + 1));
  for (int v = 0; v <= height_; ++v) {
    for (int u = 0; u <= width_; ++u) {
      const std::optional<Eigen::Vector2d> ideal = lens.idealAt(Eigen::Vector2d(u, v));
      if (!ideal) throw urban_nav_core::UserError("lens", "a distortion that folds back within the image", "");
      ideal_.push_back(ideal->cast<float>());
    }
  }
}

}  // namespace urban_nav_sim
