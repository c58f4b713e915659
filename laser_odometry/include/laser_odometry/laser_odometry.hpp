// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laser_odometry/parameters.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace laser_odometry {

/// Reason for a status other than OK (Status::reason of this stage).
enum class Reason : int {
  None = 0,
  NoPoints,       ///< no valid return in the sweep
  TooFewPoints,   ///< fewer surface patches than the parameters require
  Covered,        ///< most returns are nearer than min_range: the robot itself, or a cover
  FreeDirection,  ///< the surroundings do not constrain a direction of the motion
  Mismatch,       ///< the sweep does not fit the local map
  BadStamp,       ///< the reference time is not later than the previous one: the sweep is dropped
  Gap,            ///< time since the previous sweep much longer than the usual sweep period
  Overlap,        ///< the sweep begins long before the end of the previous one
  Planar,         ///< planar scanner: height, roll and pitch are assumed, not measured; the status is OK
  Prior,          ///< the prior contradicts the sweeps and is left out; the status is OK
};
/// Returns "" for None, else the enumerator in small letters and underscores.
const char* toString(Reason reason);

/// Kind of sensor.
enum class Scanner : int {
  Spatial = 0,  ///< 3D LiDAR
  /// Planar laser that is horizontal (urban_nav_core::isHorizontal). Only x, y and yaw of the motion are measured:
  /// walls are assumed to be vertical, and base_link to stay on the plane of its first pose.
  Planar = 1
};

/// Motion of base_link between two sweeps by another sensor (stereo, wheels, gyroscope).
struct MotionPrior {
  urban_nav_core::RelativePose step;  ///< from the previous sweep's reference time to that of this sweep
  /// Whether the translation is measured; false: it is predicted by constant velocity, and those of `step`, its
  /// covariance and `within` are not used.
  bool has_translation = true;
  bool has_tilt = true;  ///< whether roll and pitch are measured; false (wheels): `step` assumes them
  /// Covariance of the step by itself, if errors are common to consecutive steps; that of `step` is then the growth
  /// over a chain of them. nullopt: that of `step`.
  std::optional<urban_nav_core::Matrix6d> alone;
  /// Mean twist of base_link within the sweep, m/s and rad/s, for its first deskewing; nullopt: constant velocity.
  std::optional<urban_nav_core::Vector6d> within;
};

/// Statistics of one sweep.
struct Statistics {
  int points = 0;           ///< valid beams
  int near = 0;             ///< beams nearer than min_range
  int used = 0;             ///< beams in matched surface patches
  int moving = 0;           ///< beams of patches that contradict the local map
  int patches = 0;          ///< surface patches of the sweep that were matched
  int iterations = 0;       ///< of all rounds
  int map_cells = 0;        ///< of all resolutions
  double residual_m = 0.0;  ///< robust standard deviation of the distances between patches and planes
  bool deskewed = false;    ///< whether the motion within the sweep was compensated by this stage
};

/// Result for one sweep. `odom` is the first base_link.
struct LaserPose {
  urban_nav_core::StampNs stamp = 0;  ///< reference time of the sweep
  bool accepted = true;               ///< false: dropped because of its stamp; the pose is the previous one
  urban_nav_core::Pose T_odom_base;
  /// Covariance of T_first_base in the axes of the first pose, tangent as in PoseWithCovariance.
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Identity();
  /// Motion since the last accepted sweep; from == to for the first one. Along a free direction the motion and its
  /// variance are those of the prior. With Scanner::Planar, height, roll and pitch of the pose are zero and have the
  /// variances of the assumed floor.
  urban_nav_core::RelativePose step;
  /// Directions of the motion that the surroundings do not constrain: unit vectors, translation (m) before rotation
  /// (rad times the mean lever of the surfaces), in the axes of base_link. With Scanner::Planar, of x, y and yaw.
  std::vector<urban_nav_core::Vector6d> free_directions;
  urban_nav_core::Status status;
  Statistics statistics;
};

/// Surface element of the local map.
struct MapPoint {
  Eigen::Vector3f p_odom = Eigen::Vector3f::Zero();  ///< m
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, in odom; sign undefined
  float sigma = 0.0F;                                ///< standard deviation along the normal, m
};

/// Odometry by a 3D LiDAR or a horizontal planar laser: each sweep is registered to a local map of surface elements
/// (docs/derivations/laser_odometry.md).
///
/// Accepts any sweep in any order of time; each gives a finite pose and a positive definite covariance. Unusable sweeps
/// give a status with a reason. Bad data never causes an exception. Reads no clock, prints nothing. Not thread-safe;
/// different objects are independent. Deterministic: equal calls give bit-identical results.
class LaserOdometry {
 public:
  /// T_base_lidar: the sensor's frame in base_link.
  LaserOdometry(const Parameters& parameters, const urban_nav_core::Pose& T_base_lidar,
                Scanner scanner = Scanner::Spatial);
  /// Resumes from the `state` of another object. Throws UserError if that had other parameters, another T_base_lidar
  /// or another scanner, DataError if the bytes are damaged or of another version.
  LaserOdometry(const Parameters& parameters, const urban_nav_core::Pose& T_base_lidar, std::string_view state,
                Scanner scanner = Scanner::Spatial);
  ~LaserOdometry();
  LaserOdometry(LaserOdometry&&) noexcept;
  LaserOdometry& operator=(LaserOdometry&&) noexcept;

  /// Registers a sweep. `prior` replaces the prediction by constant velocity: in deskewing, as initial estimate and
  /// along free directions. Its covariance must be positive definite. A prior that contradicts the sweeps where they
  /// measure the motion is left out until it has agreed with them for seconds; the status states it.
  /// Scanner::Planar: of `prior`, x, y and yaw are used.
  LaserPose process(const urban_nav_core::Sweep& sweep, const std::optional<MotionPrior>& prior = std::nullopt);

  /// Returns the planes of the local map, at the finest resolution with a plane at each position.
  std::vector<MapPoint> localMap() const;

  /// Returns the complete state: an object constructed from it gives bit-identical results.
  std::string state() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace laser_odometry
