// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "laser_odometry/laser_odometry.hpp"
#include "urban_nav_core/motion/motion_estimates.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace laser_odometry {

/// LaserOdometry with a gyroscope, wheels or both: they predict each step, which is used in deskewing, as initial
/// estimate, along free directions, and for lost sweeps. Their bias, scales and delays are estimated from what the
/// sweeps measure (urban_nav_core::MotionSensors); a sensor that contradicts the sweeps is excluded and named. Without
/// inputs the poses are those of LaserOdometry, to the bit. Not thread-safe.
///
/// A gyroscope is used once a turn has confirmed it. Wheels are used from the start, with the standard deviations of
/// their priors, as long as the sweeps do not measure their motion: a drive that begins in a tunnel has no other
/// measurement along it.
class MotionAidedOdometry {
 public:
  MotionAidedOdometry(const Parameters& parameters, const urban_nav_core::Pose& T_base_lidar,
                      Scanner scanner = Scanner::Spatial);
  /// Resumes from the `state` of another object; throws as LaserOdometry does.
  MotionAidedOdometry(const Parameters& parameters, const urban_nav_core::Pose& T_base_lidar, std::string_view state,
                      Scanner scanner = Scanner::Spatial);
  ~MotionAidedOdometry();
  MotionAidedOdometry(MotionAidedOdometry&&) noexcept;
  MotionAidedOdometry& operator=(MotionAidedOdometry&&) noexcept;

  /// Registers a sweep. `inputs`: of the sensors since the previous sweep up to the end of this one, those of each in
  /// order of time; inputs of other sources are ignored.
  LaserPose process(const urban_nav_core::Sweep& sweep, const std::vector<urban_nav_core::MotionInput>& inputs);

  /// Returns the sensors in use and their estimated calibration, at the newest sweep.
  const urban_nav_core::MotionEstimates& motion() const;
  /// As in LaserOdometry.
  std::vector<MapPoint> localMap() const;
  std::string state() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace laser_odometry
