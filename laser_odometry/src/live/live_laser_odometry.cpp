// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_laser_odometry.hpp"

#include <chrono>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/laser/planar_sweep.hpp"
#include "urban_nav_core/sequence/time_jump.hpp"

namespace laser_odometry {

void LiveLaserOdometry::place(const urban_nav_core::Pose& T_base_lidar) {
  if (is_placed_ && isApprox(T_base_lidar, T_base_lidar_, 0.0)) return;
  end("the mounting of the LiDAR changed");
  T_base_lidar_ = T_base_lidar;
  is_placed_ = true;
}

bool LiveLaserOdometry::place(const std::optional<urban_nav_core::Pose>& T_base_lidar, const std::string& base,
                              const std::string& frame) {
  const bool is_planar = scanner_ == Scanner::Planar;
  if (!T_base_lidar) {
    setFault("no transform from " + base + " to " + frame + " on /tf_static" +
             (is_planar ? "; lasers that nod or spin are not supported" : ""));
    return false;
  }
  if (is_planar && !urban_nav_core::isHorizontal(*T_base_lidar)) {
    const double tilt = urban_nav_core::tiltOfLaser(*T_base_lidar) * 180.0 / M_PI;
    setFault("the planar laser " + frame + " is tilted by " + urban_nav_core::formatNumber(tilt, 3) + " deg against " +
             base + ": none of its scans measures again what an earlier one did; at most 10 deg are allowed");
    return false;
  }
  place(*T_base_lidar);
  return true;
}

void LiveLaserOdometry::process(const urban_nav_core::Sweep& sweep,
                                const std::vector<urban_nav_core::MotionInput>& inputs) {
  if (odometry_ && urban_nav_core::jumpsBack(sweep.reference, newest_.stamp)) end("time went back");
  if (!odometry_) {
    odometry_ = std::make_unique<MotionAidedOdometry>(parameters_, T_base_lidar_, scanner_);
    motion_ = urban_nav_core::MotionEstimates();
    begin_ = sweep.reference;
    ++sessions_;
    session_ = urban_nav_live::toOdometrySession(namer_.begin(recording_, sweep.reference).session);
  }
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const LaserPose pose = odometry_->process(sweep, inputs);
  process_ms_ = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  ++sweeps_;
  const urban_nav_core::MotionEstimates& motion = odometry_->motion();
  for (std::size_t i = motion_.faults.size(); warning_ && i < motion.faults.size(); ++i)
    warning_(describe(motion.faults[i], begin_));
  motion_ = motion;
  if (pose.accepted) newest_ = pose;
  else newest_.status = pose.status;
  if (listener_) listener_(pose, process_ms_);
}

void LiveLaserOdometry::end(const std::string& why) {
  if (!odometry_) return;
  odometry_.reset();
  newest_ = LaserPose();
  waiting_ = "no session (" + why + ")";
}

std::vector<MapPoint> LiveLaserOdometry::localMap() const {
  return odometry_ ? odometry_->localMap() : std::vector<MapPoint>();
}

urban_nav_live::StageReport LiveLaserOdometry::report() const {
  urban_nav_live::StageReport report;
  report.status = newest_.status;
  report.reason_name = toString(static_cast<Reason>(newest_.status.reason));
  if (!odometry_ || !fault_.empty()) {
    report.status.health = urban_nav_core::Health::Ok;  // no sweep; the warning below determines the level
    report.summary = fault_.empty() ? waiting_ : fault_;
    report.is_warning = true;
  }
  const Statistics& figures = newest_.statistics;
  report.add("returns", figures.points);
  report.add("returns on matched surfaces", figures.used);
  report.add("returns that contradict the map", figures.moving);
  report.add("surface patches", figures.patches);
  report.add("residual (m)", figures.residual_m);
  report.add("free directions", newest_.free_directions.size());
  report.add("cells of the local map", figures.map_cells);
  if (motion_.has_gyroscope && !motion_.gyroscope_left_out) {
    report.add("bias of the gyroscope (rad/s)", motion_.gyroscope_bias.norm());
    report.add("delay of the IMU (ms)", 1e3 * motion_.imu_offset_s);
  }
  if (motion_.has_wheels && !motion_.wheels_left_out)
    report.add("measured over true speed of the wheels", motion_.wheel_scale);
  report.add("motion sensors left out", (motion_.gyroscope_left_out ? 1 : 0) + (motion_.wheels_left_out ? 1 : 0));
  report.add("time of the last sweep (ms)", process_ms_);
  report.add("sweeps", sweeps_);
  report.add("sessions", sessions_);
  return report;
}

}  // namespace laser_odometry
