// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "urban_nav_core/sequence/right_camera_turns.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_live/beam_faults.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/stereo_sessions.hpp"
#include "urban_nav_ros/sweep_feeds.hpp"

namespace urban_nav_ros {

/// Passes the messages of subscribeRobot() to a core that builds keyframes and local clouds: stereo pairs with the
/// mounted camera, scans and sweeps with the mounting of their lasers, both poses of odometry. Used by one thread.
///
/// Requires of Sink: setCamera(optional<MountedCamera>), addPair, addTurn, restartImages, addScan, addSweep,
/// unplacedLasers, setLaser, addOdometry and addStep. It must outlive this object.
template <typename Sink, typename MountedCamera>
class RobotInputs {
 public:
  struct Listener {
    std::function<void(const std::string& fault)> refused;  ///< the calibration is not that of a stereo camera
    std::function<void()> invalid_scan;
  };

  RobotInputs(const StereoSessions::Options& options, Sink& sink, Listener listener)
      : base_frame_(options.base_frame),
        sink_(sink),
        listener_(std::move(listener)),
        sessions_(options, stereoListener()),
        sweeps_({[this](const std::string& frame, const urban_nav_core::Sweep& sweep) { sink_.addSweep(frame, sweep); },
                 [this] { listener_.invalid_scan(); }}) {}

  void handle(const ImageInput& image) { sessions_.handle(image); }
  void handle(const InfoInput& info) { sessions_.handle(info); }
  void handle(const tf2_msgs::TFMessageConstPtr& transforms) {
    sessions_.handle(transforms);
    placeLasers();
  }
  void handle(const sensor_msgs::LaserScanConstPtr& message) {
    const auto planar = toPlanarScan(*message);
    if (!planar) return listener_.invalid_scan();
    beams_.add(*planar);
    sink_.addScan(message->header.frame_id, urban_nav_core::toScan(*planar));
    placeLasers();
  }
  void handle(const sensor_msgs::PointCloud2ConstPtr& cloud) {
    sweeps_.add(cloud);
    placeLasers();
  }
  void handle(const urban_nav_core::StampedTurn& turn) { sink_.addTurn(turn); }
  void handle(const urban_nav_core::StampedPose& odometry) { sink_.addOdometry(odometry); }
  void handle(const urban_nav_core::SessionStep& step) { sink_.addStep(step); }
  /// Begins a session whose wait for /tf_static has ended. Call about ten times a second.
  void idle() { sessions_.idle(); }

  const StereoSessions& sessions() const { return sessions_; }
  const urban_nav_live::BeamFaults& beams() const { return beams_; }
  /// Returns a message if the camera's mounting is unknown; else an empty text.
  const std::string& mountingFault() const { return mounting_fault_; }
  /// Returns a message naming a laser whose mounting is unknown or whose clouds are unusable; else an empty text.
  std::string laserFault() const {
    std::string fault = sweeps_.fault();
    for (const std::string& frame : sink_.unplacedLasers()) fault = "no static tf from " + base_frame_ + " to " + frame;
    return fault;
  }

 private:
  StereoSessions::Listener stereoListener() {
    StereoSessions::Listener listener;
    listener.began = [this](const StereoSessions::Camera& camera) {
      mounting_fault_ = camera.is_mounting_known ? "" : camera.mounting;
      sink_.setCamera(MountedCamera{camera.camera, camera.T_base_left});
    };
    listener.pair = [this](DecodedPair& pair) { sink_.addPair(std::move(pair.assembled)); };
    listener.ended = [this](const std::string&) { sink_.setCamera(std::nullopt); };
    listener.went_back = [this] { sink_.restartImages(); };
    listener.refused = [this](const std::string& fault) {
      if (!fault.empty()) listener_.refused(fault);
    };
    return listener;
  }

  void placeLasers() {
    for (const std::string& frame : sink_.unplacedLasers())
      if (const auto T_base_laser = sessions_.transforms().lookup(base_frame_, frame))
        sink_.setLaser(frame, *T_base_laser);
  }

  const std::string base_frame_;
  Sink& sink_;
  const Listener listener_;
  StereoSessions sessions_;
  std::string mounting_fault_;
  urban_nav_live::BeamFaults beams_;
  SweepFeeds sweeps_;
};

}  // namespace urban_nav_ros
