// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {
class Archive;
}

namespace swf_vo {

/// Why the filter is not OK: Status::reason of every output of this stage.
enum class Reason : int {
  None = 0,
  TooFewFeatures,  ///< fewer matches than the parameters ask for
  Dark,            ///< an image without light or contrast
  Blurred,         ///< far less sharp than the frames before
  Frozen,        ///< the same pixels as the frame before while the other evidence says otherwise, or in one camera only
  Swapped,       ///< left and right exchanged: disparities are negative
  ExposureJump,  ///< brightness changed by more than matching bears
  ImageMissing,  ///< left, right or both did not come
  BadStamp,      ///< equal to or earlier than the last one: the frame is counted and dropped
  Gap,           ///< far more time since the last frame than between the frames before
  Inconsistent,  ///< matches do not agree with one rigid motion
  NotObserved,   ///< some direction of the motion is held by the prediction alone
  Corrupted,     ///< rows of an image are corrupted, as after a transfer that lost bytes; the rest is used
  NotRectified,  ///< too little could be matched because the rows of left and right disagree
  Calibration,   ///< too little could be matched, and the disparity offset is far outside its prior
};
const char* toString(Reason reason);

using LandmarkId = std::int64_t;
using FrameId = std::int64_t;  ///< counts accepted stereo frames from 0

/// A feature as it was seen in this frame, for pictures and statistics.
struct Feature {
  LandmarkId landmark = 0;
  Eigen::Vector3d pixel = Eigen::Vector3d::Zero();  ///< u_left, v, u_right (px)
  int age = 0;                                      ///< frames since it was first seen; 0: new in this frame
  bool trusted = true;                              ///< false: taken back or down-weighted below one half
};

/// A landmark of the window in the frame `odom`.
struct Landmark {
  LandmarkId id = 0;
  Eigen::Vector3d p_odom = Eigen::Vector3d::Zero();  ///< m
  float sigma = 0.0F;                                ///< standard deviation along the line of sight, m; 0: not computed
};

/// Constants of the rig that images show beside the two offsets below: estimates and standard deviations, those of the
/// priors before anything was seen. A sigma of 0: not estimated.
struct RigConstants {
  double roll_rad = 0.0, roll_sigma_rad = 0.0;  ///< of the right camera about its optical axis, against the left one
  double delay_s = 0.0, delay_sigma_s = 0.0;    ///< by which the right shutter opens later
  /// Of a relative error that all lengths of the path have in common: what the calibration (`rig_scale`) and the
  /// disparity offset leave open. It is in T_odom_base's covariance, not in those of steps.
  double scale_sigma = 0.0;
  urban_nav_core::Vector3d right_turn_rad = urban_nav_core::Vector3d::Zero();  ///< as Statistics::right_turn_rad
};

/// A motion sensor that contradicted the images and was left out.
struct MotionSensorFault {
  bool is_wheels = false;                        ///< else the gyroscope of the IMU
  bool is_named = false;                         ///< the sentence names the cause, not the difference alone
  urban_nav_core::StampNs since = 0, until = 0;  ///< `until` 0: to the end
  std::string sentence;                          ///< what is wrong, with a figure, and the remedy
};

/// Returns "wheels are left out from second 3.2 on: " and the sentence. `begin`: stamp of the first frame.
std::string describe(const MotionSensorFault& fault, urban_nav_core::StampNs begin);

/// The newest final step by images compared with a motion sensor, after the corrections that are estimated. A sigma of
/// 0: not compared.
struct MotionComparison {
  urban_nav_core::Vector3d turn_error = urban_nav_core::Vector3d::Zero();  ///< images less gyroscope, rad
  double turn_sigma = 0.0;                                                 ///< each axis, rad
  double forward = 0.0, sideways = 0.0;                                    ///< by images, m in base_link
  double forward_error = 0.0;                                              ///< images less wheels along x, m
  double forward_sigma = 0.0;                                              ///< m
};

/// Motion sensors, and what images have shown of them. Estimates and standard deviations are those of
/// the priors before anything was seen; they mean nothing for a sensor that is absent or left out.
struct MotionEstimates {
  bool has_gyroscope = false, uses_gyroscope = false, gyroscope_left_out = false;
  bool has_wheels = false, uses_wheels = false, wheels_left_out = false;
  Eigen::Vector3d gyroscope_bias = Eigen::Vector3d::Zero();  ///< measured less true, rad/s, in the axes of the IMU
  Eigen::Vector3d gyroscope_bias_sigma = Eigen::Vector3d::Zero();
  double imu_offset_s = 0.0, imu_offset_sigma_s = 0.0;          ///< delay of stamps on the clock of the cameras
  double wheel_scale = 1.0, wheel_scale_sigma = 0.0;            ///< measured speed over true
  double wheel_turn_scale = 1.0, wheel_turn_scale_sigma = 0.0;  ///< measured yaw rate over true
  double wheel_offset_s = 0.0, wheel_offset_sigma_s = 0.0;      ///< as imu_offset_s
  MotionComparison newest;
  std::vector<MotionSensorFault> faults;  ///< in order of their beginnings
};

/// Excess of disparities over those predicted from earlier frames; zero while the cameras keep their mounting.
struct DisparityStep {
  double px = 0.0, sigma_px = 0.0;  ///< sigma 0: not measured
  int landmarks = 0;                ///< that it rests on
};

/// Figures of one frame. Times are measured by the caller: a core reads no clock.
struct Statistics {
  int corners = 0;                 ///< FAST corners found in the left image, all levels
  int features = 0;                ///< features observed in this frame, new ones included
  int tracked = 0;                 ///< of these, known from earlier frames and trusted
  double track_length_mean = 0.0;  ///< frames, over the features of this frame
  double reprojection_px = 0.0;    ///< root mean square distance in the left image after the update
  int iterations = 0;
  int landmarks = 0;                       ///< in the window
  int landmarks_in_prior = 0;              ///< of these, tied to frames that have left the window
  double disparity_offset_px = 0.0;        ///< of the camera, as estimated by now: what its calibration left
  double disparity_offset_sigma_px = 0.0;  ///< its standard deviation; 0 where it is not estimated
  double row_offset_px = 0.0;  ///< by how much the right image shows everything lower than the left, as known by now
  DisparityStep disparity_step;
  /// Turn of the right camera against its calibrated orientation, found after a knock and corrected in its images
  /// (urban_nav_core::TurnedRightCamera); zero: none was found.
  urban_nav_core::Vector3d right_turn_rad = urban_nav_core::Vector3d::Zero();
  double noise_scale =
      1.0;  ///< errors of measurements in standard deviations of their alignments, as usual by now; 1 at least
};

/// A frame as it leaves the window: the settled pose, which is final.
struct Settled {
  FrameId frame = 0;
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::PoseWithCovariance T_odom_base;  ///< covariance: of T_first_base in the axes of the first pose
  /// To the settled pose before; from == to for the very first frame. Errors of the disparity offset and of the rig's
  /// scale are the same in all steps, so they are not in drift_covariance: T_odom_base's covariance has them, and
  /// `constants` the sensitivity of the step to them.
  urban_nav_core::RelativePose from_previous;
  urban_nav_core::Status status;  ///< as it was when the frame came
};

/// How base_link moves, in its own axes: m/s, then rad/s.
struct Velocity {
  urban_nav_core::Vector6d twist = urban_nav_core::Vector6d::Zero();
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Identity();
};

/// What leaves the filter for each stereo pair. `odom` is the first base_link.
struct Frame {
  FrameId frame = 0;
  urban_nav_core::StampNs stamp = 0;
  bool accepted = true;                            ///< false: dropped because of its stamp; the pose is the last one
  urban_nav_core::PoseWithCovariance T_odom_base;  ///< now: all evidence up to this frame and none after it
  Velocity velocity;  ///< since the frame before; zero with a covariance of unknown motion in the first
  urban_nav_core::Status status;
  Statistics statistics;
  RigConstants rig;              ///< as known by now
  MotionEstimates motion;        ///< as known by now
  std::vector<Settled> settled;  ///< those that left the window with this frame: none or one, more after flush
  std::vector<Feature> features;
  std::vector<Landmark> landmarks;
};

/// For states (urban_nav_core/io/archive.hpp).
void archive(urban_nav_core::Archive& archive, Feature& feature);
void archive(urban_nav_core::Archive& archive, Landmark& landmark);
void archive(urban_nav_core::Archive& archive, RigConstants& rig);
void archive(urban_nav_core::Archive& archive, MotionSensorFault& fault);
void archive(urban_nav_core::Archive& archive, MotionEstimates& motion);
void archive(urban_nav_core::Archive& archive, Statistics& statistics);
void archive(urban_nav_core::Archive& archive, Settled& settled);
void archive(urban_nav_core::Archive& archive, Frame& frame);

}  // namespace swf_vo
