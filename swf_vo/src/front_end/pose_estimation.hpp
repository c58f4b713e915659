// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "front_end/match.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

struct PoseEstimate {
  urban_nav_core::Pose T_camera_odom;
  bool found = false;  ///< enough inliers; else the pose is the first start
  int candidates = 0, inliers = 0;
  double reprojection_px = 0.0;  ///< root mean square of the inliers in the left image
};

struct PoseEstimatorOptions {
  double slack_px = 0.1;  ///< added to the standard deviation of each coordinate: errors of map and match beyond their
                          ///< covariances
  int least_inliers = 8;
  int samples = 24;  ///< poses from minimal sets that are tried in addition to the given starts
};

/// Step (iv) of section 2.4: pose of the camera by an m-estimator over the matches, including the error of a landmark's
/// first disparity, from several starts: those given, in order of preference, and poses from minimal sets chosen by a
/// fixed sequence. Starts are compared by a robust cost in which a landmark is weighted by its number of earlier inlier
/// measurements: a moving vehicle that fills the view has few. Sets `inlier` and `chi2` of each match.
class PoseEstimator {
 public:
  /// The camera must outlive this object; its disparity offset may change. `capacity`: number of matches, for which
  /// memory is allocated at construction.
  explicit PoseEstimator(const urban_nav_core::StereoCamera& camera, int capacity = 0) : camera_(camera) {
    items_.reserve(static_cast<std::size_t>(capacity));
  }

  PoseEstimate locate(const std::vector<urban_nav_core::Pose>& T_camera_odom_starts,
                      const PoseEstimatorOptions& options, std::vector<Match>& matches);

 private:
  static constexpr int kSampleSize = 3;  // three stereo points determine a motion, with redundancy
  struct Item {
    Eigen::Vector4d p_odom;
    Eigen::Vector3d z;
    Eigen::Matrix3d information;
    double trust;
    int match;
  };
  void prepare(const urban_nav_core::Pose& T_camera_odom, const PoseEstimatorOptions& options,
               const std::vector<Match>& matches);
  bool residual(const Item& item, const urban_nav_core::Pose& T_camera_odom, Eigen::Vector3d& e,
                Eigen::Matrix<double, 3, 6>* J) const;
  urban_nav_core::Pose descend(urban_nav_core::Pose T_camera_odom, int steps,
                               const std::array<int, kSampleSize>* only) const;
  double cost(const urban_nav_core::Pose& T_camera_odom) const;
  urban_nav_core::Pose bestByConsensus(const urban_nav_core::Pose& start, int samples, double& best_cost) const;

  const urban_nav_core::StereoCamera& camera_;
  std::vector<Item> items_;
};

}  // namespace swf_vo
