// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "observation.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// What the window must know of the parameters.
struct WindowOptions {
  int size = 10;                    ///< poses kept (k)
  bool forget_by_deletion = false;  ///< classic visual odometry for comparison: no information is rolled into the prior
  bool linearise_first = true;      ///< blocks touched by the prior keep their linearisation point; false: textbook EKF
  double huber = 2.5;               ///< in standard deviations; <= 0: no robust kernel
  int iterations = 3;               ///< Gauss-Newton steps of one update, at most
};

/// Motion between two neighbouring poses by the process model: T_from_to of the left camera and its information in `from`
/// (eq. 1). Zero information: the prediction starts the estimate and says nothing else.
struct ProcessInput {
  urban_nav_core::Pose T_from_to;
  urban_nav_core::Matrix6d information = urban_nav_core::Matrix6d::Zero();
};

/// A pose that left the window.
struct SettledPose {
  FrameId frame = 0;
  urban_nav_core::UncertainPose T_odom_camera;
  urban_nav_core::Pose T_previous_camera;             ///< from the settled pose before
  urban_nav_core::Matrix6d relative_covariance = urban_nav_core::Matrix6d::Zero();  ///< of T_previous_camera, in `previous`
};

struct UpdateReport {
  int iterations = 0;
  bool converged = false;
  int observations = 0;
  int downweighted = 0;           ///< with a robust weight under one half
  double reprojection_px = 0.0;   ///< root mean square over the newest frame, left image
  int landmarks = 0;
  int landmarks_in_prior = 0;
};

/// The Sliding Window Filter's back end (Newman et al. 2009, sections 2.1-2.3). Observations in, poses out: knows no
/// pixel, no image, no clock. One step is: addPose, removePoses, addLandmark.../observe..., update, in this order; at
/// size 1 this order is the extended Kalman filter's.
class Window {
 public:
  Window(const WindowOptions& options, const urban_nav_core::StereoCamera& camera);
  ~Window();

  /// The first pose, held by a prior of this information (in the parent frame; zero: gauge left free).
  void start(FrameId frame, const urban_nav_core::Pose& T_odom_camera, const urban_nav_core::Matrix6d& information);
  /// A further pose by the process model, the frame after the newest.
  void addPose(FrameId frame, const ProcessInput& u);
  /// Marginalises the oldest poses until at most `size` are left, then landmarks that no active pose sees and that are
  /// not in `followed` any more. What left is in settled() until the next call.
  void removePoses();
  const std::vector<SettledPose>& settled() const;

  /// Puts a measurement in. A landmark that is not known yet is started from it (it must then have full rank); a frame that
  /// is still in the window may be an earlier one. False if the frame or landmark has left, or it cannot be started.
  bool observe(const Observation& observation);
  /// Takes one back, or all of a landmark: exact while the frames are in the window.
  bool withdraw(LandmarkId landmark, FrameId frame);
  void withdrawAll(LandmarkId landmark);
  /// This landmark is not looked for any more: marginalised as soon as no active pose sees it.
  void endLandmark(LandmarkId landmark);

  /// Robust Gauss-Newton over all that is in the window.
  UpdateReport update();

  urban_nav_core::UncertainPose newest() const;
  urban_nav_core::Pose pose(FrameId frame) const;
  bool hasPose(FrameId frame) const;
  /// Landmarks that are still looked for, and how well the last update trusts the newest observation of each (0...1).
  const std::vector<MapPoint>& map() const;
  double weight(LandmarkId landmark) const;

  /// The rest of the window leaves, oldest first.
  std::vector<SettledPose> flush();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace swf_vo
