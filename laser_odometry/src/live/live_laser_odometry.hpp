// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "laser_odometry/motion_aided_odometry.hpp"
#include "urban_nav_live/session_namer.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace laser_odometry {

/// Laser odometry of a live robot: one object per session, and a report for the operator. Used by one thread.
class LiveLaserOdometry {
 public:
  using Listener = std::function<void(const LaserPose& pose, double process_ms)>;

  /// `robot`, `recording`: parts of the session ids; may be empty. `warning`: receives the message when a motion sensor
  /// is excluded, once for each exclusion.
  LiveLaserOdometry(const Parameters& parameters, Listener listener, Scanner scanner = Scanner::Spatial,
                    const std::string& robot = "", std::string recording = "",
                    std::function<void(const std::string& text)> warning = {})
      : parameters_(parameters),
        scanner_(scanner),
        listener_(std::move(listener)),
        warning_(std::move(warning)),
        recording_(std::move(recording)),
        namer_(robot) {}

  /// Sets the pose of the LiDAR on the robot. A change ends the session.
  void place(const urban_nav_core::Pose& T_base_lidar);
  /// Sets the pose as known by tf. Returns false, with a fault that names the frames, if it is unknown or that of a
  /// planar laser that is not horizontal.
  bool place(const std::optional<urban_nav_core::Pose>& T_base_lidar, const std::string& base,
             const std::string& frame);
  /// Processes a sweep. The first one begins a session, as does a sweep whose reference is more than a second before
  /// the newest. `inputs`: as in MotionAidedOdometry. Requires place().
  void process(const urban_nav_core::Sweep& sweep, const std::vector<urban_nav_core::MotionInput>& inputs = {});
  /// Ends the session. `why`: for the report.
  void end(const std::string& why);
  /// Sets the reason why sweeps cannot be used; empty: no fault.
  void setFault(const std::string& fault) { fault_ = fault; }

  bool isPlaced() const { return is_placed_; }
  bool isRunning() const { return odometry_ != nullptr; }
  std::int64_t sessions() const { return sessions_; }
  /// Returns the session of the newest sweep; null before the first.
  const urban_nav_core::OdometrySessionPtr& session() const { return session_; }
  /// Returns the planes of the local map; empty without a session.
  std::vector<MapPoint> localMap() const;
  /// Returns the report for the operator: a warning while there is no session.
  urban_nav_live::StageReport report() const;

 private:
  const Parameters parameters_;
  const Scanner scanner_;
  const Listener listener_;
  const std::function<void(const std::string& text)> warning_;
  const std::string recording_;
  urban_nav_live::SessionNamer namer_;
  urban_nav_core::OdometrySessionPtr session_;
  bool is_placed_ = false;
  urban_nav_core::Pose T_base_lidar_;
  std::unique_ptr<MotionAidedOdometry> odometry_;
  urban_nav_core::MotionEstimates motion_;
  urban_nav_core::StampNs begin_ = 0;  // first sweep of the session
  LaserPose newest_;
  double process_ms_ = 0.0;
  std::int64_t sweeps_ = 0, sessions_ = 0;
  std::string waiting_ = "no sweeps yet", fault_;
};

}  // namespace laser_odometry
