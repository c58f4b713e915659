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

/// Options of the window.
struct WindowOptions {
  int size = 10;  ///< poses kept (k)
  bool forget_by_deletion =
      false;  ///< classic visual odometry, for comparison: no information is marginalised into the prior. One more
              ///< pose, the oldest, is kept as the datum: size 1 is frame-to-frame odometry
  bool linearise_first = true;  ///< blocks of the prior keep their linearisation point; false: textbook EKF
  double huber = 2.5;           ///< in standard deviations of a stereo pixel (Mahalanobis); <= 0: no robust kernel
  int iterations = 3;       ///< maximum number of Gauss-Newton steps per update; 1: one step from the prediction, as in
                            ///< an EKF
  double tolerance = 1e-5;  ///< stops once the predicted decrease of the cost (chi-square) of a step is below this
  bool exact_undo =
      true;  ///< withdraw and late observe give the exact result (undo.hpp); false: only the measurement is inserted or
             ///< removed, and marginalised terms keep their linearisation points
  double datum_ratio = 100.0;  ///< once the variance of the pose of the whole window exceeds this multiple of that of a
                               ///< single frame, the gauge is fixed again and the difference carried separately
                               ///< (datum.hpp); affects rounding only
  double disparity_offset =
      0.0;  ///< px, standard deviation of the camera's disparity offset, which is then a state; 0: it is a constant
  double rig_scale = 0.0;     ///< relative standard deviation of focal length times baseline, hence of all lengths
  bool robust_drift = false;  ///< scales the drift by the ratio estimated from landmark residuals (drift_sandwich.hpp);
                              ///< false: drift of the model
  int landmarks = 64;         ///< expected number of landmarks; memory for them is allocated at the start
  bool keep_history = false;  ///< keep the eliminated rows for Window::trajectory(): grows with the trajectory
};

/// A pose that left the window.
///
/// WARNING: relative covariances of successive steps are correlated. The error of a step consists of the errors of the
/// frames at its ends and of the drift between them; the next step begins with the end error of this one, and reverses
/// it. Composed as if independent, relative_covariance is correct for one step and 5 to 50 times too large over 100.
/// The covariance of the motion from frame i to frame j is the composition of drift_covariance over all its steps, with
/// half of relative_covariance added to the first and to the last (for a single step: relative_covariance). Measured:
/// bench/consistency_tracks. Errors of the disparity offset and of the rig's scale are common to all steps and not in
/// the drift: the covariance of T_odom_camera includes them, and `constants` holds the sensitivity of each step to
/// them.
struct SettledPose {
  FrameId frame = 0;
  urban_nav_core::PoseWithCovariance T_odom_camera;  ///< previous pose times T_previous_camera, to the last bit
  urban_nav_core::Pose T_previous_camera;            ///< from the previous settled pose; identity for the first
  urban_nav_core::Matrix6d relative_covariance =
      urban_nav_core::Matrix6d::Zero();  ///< covariance of T_previous_camera, in `previous`, both at settling
  urban_nav_core::Matrix6d drift_covariance =
      urban_nav_core::Matrix6d::Zero();  ///< the part that accumulates over steps; equal to relative_covariance if the
                                         ///< filter does not separate the gauge (datum.hpp)
  urban_nav_core::ConsideredConstants constants;  ///< sensitivity of T_previous_camera, in `previous`
};

struct UpdateReport {
  int iterations = 0;
  bool converged = false;
  int observations = 0;          ///< in the window, without dropped ones
  int downweighted = 0;          ///< with a robust weight below one half
  int dropped = 0;               ///< landmarks behind a camera or not finite: without influence
  double reprojection_px = 0.0;  ///< root mean square over the newest frame, left image
  int landmarks = 0;
  int landmarks_in_prior = 0;
};

/// Back end of the sliding window filter (Newman et al. 2009, sections 2.1-2.3): observations in, poses out,
/// independent of pixels, images and clocks. Order of calls in a step: addPose, removePoses, endLandmark.../observe...,
/// update; at size 1 this order (propagate, marginalise, update) is that of the extended Kalman filter. Results are
/// always finite: unobserved directions remain at the prediction, with the variance of process_model::floor(). Not
/// thread-safe. Deterministic: equal calls give bit-identical results.
class Window {
 public:
  Window(const WindowOptions& options, const urban_nav_core::StereoCamera& camera);
  ~Window();
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;

  /// Adds the first pose with a prior of this information (in the parent frame). If it is singular, the pose in `odom`
  /// is unknown: the gauge is free, and covariances are relative to the oldest pose of the window.
  void start(FrameId frame, const urban_nav_core::Pose& T_odom_camera, const urban_nav_core::Matrix6d& information);
  /// Adds the next pose by the process model, after the newest.
  void addPose(FrameId frame, const ProcessInput& u);
  /// Adds the next pose by the process model when no tracked landmark links it to the previous ones. All previous poses
  /// leave (settled()), and the window restarts at the prediction, with its covariance.
  void restart(FrameId frame, const ProcessInput& u);
  /// Marginalises the oldest poses until at most `size` are left, with the landmarks that have no measurement in an
  /// active pose and are no longer tracked. The removed poses are in settled() until the next call.
  void removePoses();
  const std::vector<SettledPose>& settled() const;

  /// Adds a landmark of known position (a surveyed beacon), a constant. Returns false if it is active already.
  bool fixLandmark(const MapPoint& point);
  /// Adds a measurement. An unknown landmark is initialised from it, which requires full rank; the frame may be any
  /// frame of the window. Returns false if the frame has left, the landmark was measured in it already, it cannot be
  /// initialised, or a number is not finite.
  bool observe(const Observation& observation);
  /// Withdraws one measurement, or all of a landmark in active frames: exact while the frames are in the window
  /// (exact_undo). Returns false if there is none. Takes effect with the next update().
  bool withdraw(LandmarkId landmark, FrameId frame);
  void withdrawAll(LandmarkId landmark);
  /// Marks a landmark as no longer tracked: it is marginalised as soon as no active pose has a measurement of it.
  void endLandmark(LandmarkId landmark);

  /// Robust Gauss-Newton over the window.
  UpdateReport update();

  /// Returns the newest pose; before update() the prediction, or the initial estimate of the process input. Requires
  /// start().
  urban_nav_core::PoseWithCovariance newest() const;
  urban_nav_core::Pose pose(FrameId frame) const;  ///< pose of an active frame
  bool hasPose(FrameId frame) const;
  std::size_t poses() const;  ///< number of active poses
  /// Current estimate of the camera's disparity offset, px, and its standard deviation (0 if it is a constant).
  double disparityOffset() const;
  double disparityOffsetSigma() const;
  /// Relative standard deviation of all lengths of the path, due to the disparity offset and the rig.
  double scaleSigma() const;
  /// Tracked landmarks, in order of id; valid until the next change.
  const std::vector<MapPoint>& map() const;
  /// Returns the robust weight of the newest observation of a landmark in the last update (0...1); 1 without
  /// observation.
  double weight(LandmarkId landmark) const;

  /// Returns landmarks that are not static (drifting_landmarks.hpp) according to the last update: to be withdrawn and
  /// ended. Valid until the next call.
  const std::vector<LandmarkId>& driftingLandmarks();

  /// Removes and returns the remaining poses, oldest first. The window must not be used afterwards.
  std::vector<SettledPose> flush();

  /// Solves the full system by back-substitution: all frames, given all measurements (keep_history).
  std::map<FrameId, urban_nav_core::Pose> trajectory() const;

  /// Not supported with exact_undo or keep_history, whose records are not archived.
  void archive(urban_nav_core::Archive& archive);

  /// Internal state, for tests and benches.
  const Filter& filter() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace swf_vo
