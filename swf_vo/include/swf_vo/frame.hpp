// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "urban_nav_core/motion/motion_estimates.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {
class Archive;
}

namespace swf_vo {

/// Reason for a status other than OK (Status::reason of this stage).
enum class Reason : int {
  None = 0,
  TooFewFeatures,  ///< fewer matches than the parameters require
  Dark,            ///< image without light or contrast
  Blurred,         ///< much less sharp than the previous frames
  Frozen,          ///< same pixels as the previous frame although other evidence shows motion, or in one camera only
  Swapped,         ///< left and right exchanged: disparities are negative
  ExposureJump,    ///< brightness change too large for patch matching
  ImageMissing,    ///< left, right or both images are missing
  BadStamp,        ///< stamp not later than the previous one: the frame is counted and dropped
  Gap,             ///< time since the previous frame much longer than the usual frame period
  Inconsistent,    ///< matches are inconsistent with one rigid motion
  NotObserved,     ///< a direction of the motion is constrained by the prediction only
  Corrupted,       ///< corrupted image rows, as after an incomplete transfer; the other rows are used
  NotRectified,    ///< too few matches because the rows of left and right image disagree
  Calibration,     ///< too few matches, and the disparity offset is far outside its prior
};
const char* toString(Reason reason);

using LandmarkId = std::int64_t;
using FrameId = std::int64_t;  ///< counts accepted stereo frames from 0

/// A feature measured in this frame, for visualisation and statistics.
struct Feature {
  LandmarkId landmark = 0;
  Eigen::Vector3d pixel = Eigen::Vector3d::Zero();  ///< u_left, v, u_right (px)
  int age = 0;                                      ///< frames since its first observation; 0: new in this frame
  bool trusted = true;                              ///< false: withdrawn, or robust weight below one half
};

/// A landmark of the window, in the frame `odom`.
struct Landmark {
  LandmarkId id = 0;
  Eigen::Vector3d p_odom = Eigen::Vector3d::Zero();  ///< m
  float sigma = 0.0F;                                ///< standard deviation along the line of sight, m; 0: not computed
};

/// Rig constants estimated from images, besides the offsets in Statistics. Until the first measurement, estimates and
/// standard deviations are those of the priors. A sigma of 0: not estimated.
struct RigConstants {
  double roll_rad = 0.0, roll_sigma_rad = 0.0;  ///< right camera relative to the left one, about its optical axis
  double delay_s = 0.0, delay_sigma_s = 0.0;    ///< delay of the right shutter relative to the left one
  /// Standard deviation of the relative scale error common to all lengths of the path: uncertainty of the calibration
  /// (`rig_scale`) and of the disparity offset. Included in the covariance of T_odom_base, not in those of steps.
  double scale_sigma = 0.0;
  urban_nav_core::Vector3d right_turn_rad = urban_nav_core::Vector3d::Zero();  ///< as Statistics::right_turn_rad
};

// Motion sensors: the reference is the odometry by images.
using urban_nav_core::describe;
using urban_nav_core::MotionComparison;
using urban_nav_core::MotionEstimates;
using urban_nav_core::MotionSensorFault;

/// Measured disparities minus those predicted from earlier frames; zero while the cameras keep their mounting.
struct DisparityStep {
  double px = 0.0, sigma_px = 0.0;  ///< sigma 0: not measured
  int landmarks = 0;                ///< number of landmarks used
};

/// Statistics of one frame. Times are measured by the caller: the core reads no clock.
struct Statistics {
  int corners = 0;                 ///< FAST corners found in the left image, all levels
  int features = 0;                ///< features observed in this frame, new ones included
  int tracked = 0;                 ///< tracked from earlier frames and trusted
  double track_length_mean = 0.0;  ///< frames, over the features of this frame
  double reprojection_px = 0.0;    ///< root mean square distance in the left image after the update
  int iterations = 0;
  int landmarks = 0;                       ///< in the window
  int landmarks_in_prior = 0;              ///< observed from frames that have left the window
  double disparity_offset_px = 0.0;        ///< current estimate of the camera's disparity offset, a calibration error
  double disparity_offset_sigma_px = 0.0;  ///< its standard deviation; 0 where it is not estimated
  double row_offset_px = 0.0;              ///< row in the right image minus row in the left one, current estimate
  DisparityStep disparity_step;
  /// Turn of the right camera against its calibrated orientation, found after a knock and corrected in its images
  /// (urban_nav_core::TurnedRightCamera); zero: none was found.
  urban_nav_core::Vector3d right_turn_rad = urban_nav_core::Vector3d::Zero();
  double noise_scale =
      1.0;  ///< measurement errors in standard deviations of their alignments, typical current value; at least 1
};

/// A frame that leaves the window, with its smoothed pose, which is final.
struct Settled {
  FrameId frame = 0;
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::PoseWithCovariance T_odom_base;  ///< covariance: of T_first_base in the axes of the first pose
  /// Relative to the previous settled pose; from == to for the very first frame. Errors of the disparity offset and of
  /// the rig's scale are common to all steps and therefore not in drift_covariance: the covariance of T_odom_base
  /// includes them, and `constants` holds the sensitivity of the step to them.
  urban_nav_core::RelativePose from_previous;
  urban_nav_core::Status status;  ///< at the time of the frame
};

using Velocity = urban_nav_core::BodyTwist;

/// Output for one stereo pair. `odom` is the first base_link.
struct Frame {
  FrameId frame = 0;
  urban_nav_core::StampNs stamp = 0;
  bool accepted = true;                            ///< false: dropped because of its stamp; the pose is that of the
                                                   ///< previous frame
  urban_nav_core::PoseWithCovariance T_odom_base;  ///< filtered: from the data up to this frame
  Velocity velocity;  ///< mean since the previous frame; in the first frame zero with the covariance of unknown motion
  urban_nav_core::Status status;
  Statistics statistics;
  RigConstants rig;              ///< current estimates
  MotionEstimates motion;        ///< current estimates
  std::vector<Settled> settled;  ///< frames that left the window with this one: none or one; all at a restart of the
                                 ///< window
  std::vector<Feature> features;
  std::vector<Landmark> landmarks;
};

/// Serialisation of the filter's state (urban_nav_core/io/archive.hpp).
void archive(urban_nav_core::Archive& archive, Feature& feature);
void archive(urban_nav_core::Archive& archive, Landmark& landmark);
void archive(urban_nav_core::Archive& archive, RigConstants& rig);
void archive(urban_nav_core::Archive& archive, Statistics& statistics);
void archive(urban_nav_core::Archive& archive, Settled& settled);
void archive(urban_nav_core::Archive& archive, Frame& frame);

}  // namespace swf_vo
