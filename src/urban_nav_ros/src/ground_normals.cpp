// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/ground_normals.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::GroundNormal;

namespace {

constexpr std::chrono::seconds kTfTimeout{1};
constexpr std::size_t kMostNormals = 1000;

/// Returns the standard deviation of a normal's direction, rad; NaN if the message is not finite.
double directionSigma(const urban_nav_msgs::GroundPlane& message) {
  Eigen::Matrix3d covariance;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      covariance(row, column) = message.covariance[static_cast<std::size_t>(4 * row + column)];
  if (!covariance.allFinite()) return std::nan("");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, axes.eigenvalues()(2)));
}

}  // namespace

std::vector<GroundNormal> GroundNormals::add(const urban_nav_msgs::GroundPlane& message) {
  if (!frame_) {
    frame_ = message.header.frame_id;
    first_ = std::chrono::steady_clock::now();
  }
  const Eigen::Vector3d up(message.up.x, message.up.y, message.up.z);
  const double sigma = directionSigma(message);
  const bool is_plane = message.verdict == urban_nav_msgs::GroundPlane::FOUND && std::abs(up.norm() - 1.0) < 1e-3 &&
                        std::isfinite(message.height) && std::isfinite(message.support) && std::isfinite(sigma);
  if (!is_plane || waiting_.size() >= kMostNormals) return {};
  waiting_.push_back({toStampNs(message.header.stamp), up.normalized(), sigma, message.height, message.support});
  return takeConverted();
}

std::vector<GroundNormal> GroundNormals::add(const tf2_msgs::TFMessage& message) {
  transforms_.add(message);
  return takeConverted();
}

std::vector<GroundNormal> GroundNormals::takeConverted() {
  if ((!T_base_camera_ || is_assumed_) && frame_) {
    if (const auto known = transforms_.lookup(base_frame_, *frame_)) {
      T_base_camera_ = known;
      is_assumed_ = false;
    }
  }
  if (!T_base_camera_ && frame_ && std::chrono::steady_clock::now() - first_ > kTfTimeout) {
    T_base_camera_ = opticalInBody();
    is_assumed_ = true;
  }
  if (!T_base_camera_) return {};
  std::vector<GroundNormal> made = std::exchange(waiting_, {});
  for (GroundNormal& normal : made) {
    normal.up = T_base_camera_->R() * normal.up;
    normal.height -= normal.up.dot(T_base_camera_->t());
  }
  return made;
}

}  // namespace urban_nav_ros
