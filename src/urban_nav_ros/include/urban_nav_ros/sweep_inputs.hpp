// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "urban_nav_core/laser/planar_sweep.hpp"
#include "urban_nav_core/sequence/motion_input_parameters.hpp"
#include "urban_nav_core/sequence/sweep_motion_queue.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_live/round_gate.hpp"
#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/motion.hpp"
#include "urban_nav_ros/sweep_feed.hpp"

namespace urban_nav_ros {

/// Converts the messages of one LiDAR or planar laser to sweeps with the motion inputs between them: the sequence is
/// that of the reader of recordings. Used by one thread.
class SweepInputs {
 public:
  using Message = std::variant<tf2_msgs::TFMessageConstPtr, sensor_msgs::PointCloud2ConstPtr,
                               sensor_msgs::LaserScanConstPtr, nav_msgs::OdometryConstPtr, sensor_msgs::ImuConstPtr>;
  struct Options {
    std::string base_frame = urban_nav_core::frames::kBaseLink;
    urban_nav_core::CloudOptions clouds;
    urban_nav_core::MotionChoice motion;  ///< sensor_msgs/Imu and nav_msgs/Odometry that are motion inputs
    double max_lateness = 0.1;            ///< s of stamps that a sweep waits for motion inputs
    double wheel_noise = 0.0;             ///< parameter of WheelMotion
    double gyro_noise = 0.0;              ///< parameter of GyroMotion, rad/s
  };
  struct Listener {
    /// Sets the mounting of the sensor; nullopt: unknown. Returns whether its sweeps are used.
    std::function<bool(const std::optional<urban_nav_core::Pose>& T_base_sensor, const std::string& frame)> place;
    std::function<void(const urban_nav_core::Sweep&, const std::vector<urban_nav_core::MotionInput>&)> sweep;
    std::function<void(const std::string& why)> ended;      ///< later sweeps do not continue the earlier ones
    std::function<void(const std::string& fault)> fault;    ///< why the messages are not used; empty: they are
    std::function<void(const std::string& fault)> invalid;  ///< a message that is dropped
  };

  SweepInputs(const Options& options, Listener listener);

  void handle(const Message& message);
  /// Passes the waiting sweeps to the listener.
  void flush();
  /// Drops the waiting sweeps and inputs.
  void restart();
  const std::string& frame() const { return frame_; }
  void addTo(urban_nav_live::StageReport& report) const;

 private:
  using Queue = urban_nav_core::SweepMotionQueue<urban_nav_core::Sweep>;
  struct Rate {
    sensor_msgs::ImuConstPtr message;
    urban_nav_core::Matrix3d R_base_imu;
  };
  using Item = std::variant<urban_nav_core::Sweep, nav_msgs::OdometryConstPtr, Rate>;

  void add(const sensor_msgs::PointCloud2ConstPtr& cloud);
  void add(const sensor_msgs::LaserScanConstPtr& scan);
  void add(const sensor_msgs::ImuConstPtr& message);
  void add(urban_nav_core::Sweep sweep);
  bool place(const std::string& frame);
  void end(const std::string& why);
  void feed(Item& item);
  void deliver();

  const Options options_;
  const Listener listener_;
  const Queue::Options queue_options_;
  StaticTransforms transforms_;
  std::string frame_;                                  // the frame of the sensor; empty before its first message
  std::optional<urban_nav_core::Pose> T_base_sensor_;  // mounting for the waiting sweeps
  std::optional<SweepFeed> feed_;
  urban_nav_core::PlanarSweepReader scans_;
  std::string imu_frame_;                           // empty before the first message
  std::optional<urban_nav_core::Pose> T_base_imu_;  // nullopt: unknown, its axes are those of the robot
  Queue queue_;
  WheelMotion wheels_;
  std::optional<GyroMotion> gyroscope_;
  urban_nav_live::RoundGate<Item> rounds_;
  std::int64_t inputs_ = 0, late_ = 0;
};

}  // namespace urban_nav_ros
