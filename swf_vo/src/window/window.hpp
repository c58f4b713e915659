// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "observation.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "window/process_model.hpp"

namespace swf_vo {

class Filter;

/// What the window must know of the parameters.
struct WindowOptions {
  int size = 10;  ///< poses kept (k)
  bool forget_by_deletion =
      false;  ///< classic visual odometry for comparison: no information is rolled into the prior. One pose
              ///< more is kept, the oldest, as the datum: size 1 is odometry from frame to frame
  bool linearise_first = true;  ///< blocks touched by the prior keep their linearisation point; false: textbook EKF
  double huber = 2.5;           ///< in standard deviations of a stereo pixel (Mahalanobis); <= 0: no robust kernel
  int iterations = 3;       ///< Gauss-Newton steps of one update, at most; 1: one step from the prediction, as the EKF
  double tolerance = 1e-5;  ///< stops once a step promises to lower the cost (in chi-square) by less than this
  bool exact_undo =
      true;  ///< withdraw and late observe as if it had always been so (undo.hpp); false: the measurement itself
             ///< goes in or out, but what was marginalised since keeps the linearisation points it had
  double datum_ratio = 100.0;  ///< once the place of the whole window is this much less certain than what one frame
                               ///< tells of its own pose (in variance), it is held anew and the difference carried
                               ///< beside (datum.hpp): changes no result but for rounding
  double disparity_offset =
      0.0;  ///< px, standard deviation of the camera's disparity offset, which is then a state; 0: it is a constant
  double rig_scale = 0.0;     ///< standard deviation of focal length times baseline, relative: of all lengths at once
  bool robust_drift = false;  ///< scales the drift by what the residuals of whole landmarks say of it
                              ///< (drift_sandwich.hpp); false: it is the model's
  int landmarks = 64;         ///< so many at once are expected; memory for them is taken at the start
  bool keep_history = false;  ///< keep the eliminated rows for Window::trajectory(): grows with the trajectory
};

/// A pose that left the window.
///
/// WARNING: relative covariances of neighbours are correlated. A step is off by the errors of the two frames at its
/// ends and by the drift between them; the next step begins with the error with which this one ends, and takes it
/// back. Composed as if independent, relative_covariance is right for one step and 5 to 50 times too large over 100.
/// What adds up is the drift: the covariance of the way from frame i to frame j is that composed of the
/// drift_covariance of all its steps, with half of relative_covariance added to the first and to the last (a single
/// step: relative_covariance alone). Measured: bench/consistency_tracks. Errors of the
/// disparity offset and of the rig's scale are the same in all steps and not in the drift: the covariance of
/// T_odom_camera has them, and `constants` the sensitivity of each step to them.
struct SettledPose {
  FrameId frame = 0;
  urban_nav_core::PoseWithCovariance T_odom_camera;  ///< previous pose times T_previous_camera, to the last bit
  urban_nav_core::Pose T_previous_camera;            ///< from the settled pose before; identity for the first
  urban_nav_core::Matrix6d relative_covariance =
      urban_nav_core::Matrix6d::Zero();  ///< of T_previous_camera, in `previous`: between both as they settled
  urban_nav_core::Matrix6d drift_covariance =
      urban_nav_core::Matrix6d::Zero();  ///< that part of it which adds up over steps; all of it where the
                                         ///< filter does not keep the gauge apart (datum.hpp)
  urban_nav_core::ConsideredConstants constants;  ///< of T_previous_camera, in `previous`
};

struct UpdateReport {
  int iterations = 0;
  bool converged = false;
  int observations = 0;          ///< in the window, dropped ones apart
  int downweighted = 0;          ///< with a robust weight under one half
  int dropped = 0;               ///< of landmarks that came to lie behind a camera or nowhere: without influence
  double reprojection_px = 0.0;  ///< root mean square over the newest frame, left image
  int landmarks = 0;
  int landmarks_in_prior = 0;
};

/// The Sliding Window Filter's back end (Newman et al. 2009, sections 2.1-2.3). Observations in, poses out: knows no
/// pixel, no image, no clock. One step is: addPose, removePoses, endLandmark.../observe..., update, in this order; at
/// size 1 this order (propagate, marginalise, update) is the extended Kalman filter's. Never NaN: what nothing
/// determines stays where the prediction put it, with the variance of process_model::floor(). Not thread-safe. The same
/// calls give the same bits.
class Window {
 public:
  Window(const WindowOptions& options, const urban_nav_core::StereoCamera& camera);
  ~Window();
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;

  /// The first pose, held by a prior of this information (in the parent frame). If it is singular, nothing says where
  /// `odom` is: the gauge is left free, and covariances are relative to the oldest pose of the window.
  void start(FrameId frame, const urban_nav_core::Pose& T_odom_camera, const urban_nav_core::Matrix6d& information);
  /// A further pose by the process model, the frame after the newest.
  void addPose(FrameId frame, const ProcessInput& u);
  /// A further pose by the process model that nothing else will ever tie to those before: no landmark is left that is
  /// still looked for. All of them leave (settled()), and the window begins anew at the prediction, with its
  /// covariance.
  void restart(FrameId frame, const ProcessInput& u);
  /// Marginalises the oldest poses until at most `size` are left, with them landmarks that no active pose sees and that
  /// are not followed any more. What left is in settled() until the next call.
  void removePoses();
  const std::vector<SettledPose>& settled() const;

  /// A landmark whose place is known (a surveyed beacon): a constant. False if it is active already.
  bool fixLandmark(const MapPoint& point);
  /// Puts a measurement in. A landmark that is not known yet is started from it (it must then have full rank); a frame
  /// that is still in the window may be an earlier one. False if the frame has left, the landmark was seen from it
  /// already, it cannot be started, or a number is not finite.
  bool observe(const Observation& observation);
  /// Takes one back, or all of a landmark that active frames saw: exact while the frames are in the window
  /// (exact_undo). False if there is none. Takes effect with the next update().
  bool withdraw(LandmarkId landmark, FrameId frame);
  void withdrawAll(LandmarkId landmark);
  /// This landmark is not looked for any more: marginalised as soon as no active pose sees it.
  void endLandmark(LandmarkId landmark);

  /// Robust Gauss-Newton over all that is in the window.
  UpdateReport update();

  /// Before update(): the prediction, or where the process input has the estimate begin. The window must have been
  /// started.
  urban_nav_core::PoseWithCovariance newest() const;
  urban_nav_core::Pose pose(FrameId frame) const;  ///< of an active frame
  bool hasPose(FrameId frame) const;
  std::size_t poses() const;  ///< that are active
  /// The camera's disparity offset as known now, px, and its standard deviation (0 if it is a constant).
  double disparityOffset() const;
  double disparityOffsetSigma() const;
  /// Standard deviation of a relative error of all lengths of the path: what the offset and the rig make of it.
  double scaleSigma() const;
  /// Landmarks that are still looked for, in order of id; lives until the next change.
  const std::vector<MapPoint>& map() const;
  /// How well the last update trusts the newest observation of it (0...1); 1 if it has none.
  double weight(LandmarkId landmark) const;

  /// Landmarks that do not keep still (drifting_landmarks.hpp), by the last update: to be withdrawn and ended. Lives
  /// until the next call.
  const std::vector<LandmarkId>& driftingLandmarks();

  /// The rest of the window leaves, oldest first. The window cannot go on after it.
  std::vector<SettledPose> flush();

  /// The full system solved by back-substitution: every frame ever seen, given all that is known now (keep_history).
  std::map<FrameId, urban_nav_core::Pose> trajectory() const;

  /// Not with exact_undo or keep_history, whose memory it does not have.
  void archive(urban_nav_core::Archive& archive);

  /// What is inside, for tests and benches.
  const Filter& filter() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace swf_vo
