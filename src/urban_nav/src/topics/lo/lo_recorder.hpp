// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laser_odometry/motion_aided_odometry.hpp"
#include "map/session_pass.hpp"
#include "topics/lo/lo_run.hpp"

namespace urban_nav {

/// Feeds laser odometry with the sweeps of the first LiDAR and with the motion sensors, and records its output for
/// files and report. Not thread-safe.
class LoRecorder {
 public:
  /// `run`: filled while sweeps are processed; must outlive the recorder.
  LoRecorder(const laser_odometry::Parameters& parameters, const urban_nav_input::SourceInfo& info, LoRun& run);
  /// Continues bit-exactly from the `state` of another recorder. Throws UserError if the parameters
  /// differ, DataError if the state is damaged.
  LoRecorder(const laser_odometry::Parameters& parameters, const urban_nav_input::SourceInfo& info, LoRun& run,
             std::string_view state);

  void process(const urban_nav_input::SweepInput& input);
  void finish(const PassEnd& end);
  /// Returns the state of run and odometry. Requires that finish() has not been called.
  std::string state() const;

 private:
  laser_odometry::Scanner scanner() const;
  void record(const laser_odometry::LaserPose& pose, double ms);
  void sampleSurface();

  const laser_odometry::Parameters parameters_;
  LoRun& run_;
  std::optional<laser_odometry::MotionAidedOdometry>
      odometry_;  ///< empty before the first sweep, which has the mounting
  urban_nav_core::Pose T_base_lidar_;
  std::optional<urban_nav_core::Vector3d> sampled_at_;  ///< position of the last sample of the surface, m
  std::vector<urban_nav_core::MotionInput> inputs_;     ///< since the last sweep of the LiDAR
  std::int64_t others_ = 0;                             ///< sweeps of other LiDARs, which are not used
  std::int64_t untimed_ = 0;                            ///< sweeps whose points have no times
};

}  // namespace urban_nav
