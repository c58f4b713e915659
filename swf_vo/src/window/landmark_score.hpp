// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/io/archive.hpp"
#include "window/cost.hpp"

namespace swf_vo {

/// Score and information of a constant-rate drift of the camera: shift (m) and turn (rad) per radian of view change,
/// about the camera, in its axes.
struct DriftScore {
  urban_nav_core::Vector6d score = urban_nav_core::Vector6d::Zero();
  urban_nav_core::Matrix6d information = urban_nav_core::Matrix6d::Zero();
  /// For the disparity offset (px), jointly with the drift; `offset_cross`: information between both.
  double offset_score = 0.0, offset_information = 0.0;
  urban_nav_core::Vector6d offset_cross = urban_nav_core::Vector6d::Zero();
  double life = 0.0;                                    ///< view change (rad) from the first to the last measurement
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  ///< direction of the landmark in that camera: (x, y) / z
};

/// Score of a constant-rate camera drift over the landmark's lifetime.
///
/// An information filter over theta, the drift rate xi of the camera relative to its estimate, and the disparity
/// offset; poses are otherwise taken as known. With theta eliminated, the result is the contribution of the landmark to
/// score and information of the trajectory at low frequencies: changes slower than its lifetime. Process noise is the
/// same as in the prior (landmark_process_noise.hpp). Derivation: docs/derivations/cluster_robust_drift.md.
class LandmarkScore {
 public:
  bool isUsed() const { return used_; }
  void clear() { used_ = false; }

  /// Adds a measurement that leaves the window with its pose, at this view change (rad) since the start; `term`: as
  /// marginalised into the prior.
  void add(const LandmarkBlock& landmark, const PoseBlock& pose, double view_change, const SensorTerm& term);
  /// Adds template drift since the previous measurement (covariance of the bearing).
  void age(const Eigen::Matrix2d& covariance);
  /// Returns the score in the axes of the camera of its last frame.
  DriftScore evaluate(const urban_nav_core::Pose& T_odom_camera) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  using Matrix10d = Eigen::Matrix<double, 10, 10>;
  using Vector10d = Eigen::Matrix<double, 10, 1>;

  bool used_ = false;
  double born_ = 0.0, last_ = 0.0;                       // view change, rad
  Eigen::Vector3d reference_ = Eigen::Vector3d::Zero();  // theta at which score_ is taken
  Anchor anchor_;                                        // xi is about its origin
  Matrix10d information_ = Matrix10d::Zero();            // states: theta, xi, offset
  Vector10d score_ = Vector10d::Zero();
};

}  // namespace swf_vo
