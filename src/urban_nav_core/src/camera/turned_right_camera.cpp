// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/turned_right_camera.hpp"

#include <Eigen/Geometry>

namespace urban_nav_core {

void TurnedRightCamera::set(const Eigen::Vector3d& turn) {
  if (turn == turn_) return;
  turn_ = turn;
  map_.reset();
  if (turn.isZero(0.0)) return;
  RawCamera right{camera_.left, Distortion()};
  right.pinhole.cx -= camera_.disparity_offset;
  const Eigen::Matrix3d R_calibrated_turned = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  map_.emplace(right, R_calibrated_turned, right.pinhole);
}

ImageView TurnedRightCamera::correct(const ImageView& right, std::vector<std::uint8_t>& out) const {
  if (!map_) return right;
  const ImageView corrected = map_->remap(right, out);
  return corrected.empty() ? right : corrected;
}

}  // namespace urban_nav_core
