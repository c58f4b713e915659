// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/sweep_inputs.hpp"

#include <cmath>
#include <utility>

#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::Pose;
using urban_nav_core::Sweep;

namespace {

constexpr int kSweepRound = 0, kWheelRound = 1, kRateRound = 2;  // streams of the rounds

urban_nav_core::SweepMotionQueue<Sweep>::Options toQueueOptions(const SweepInputs::Options& options) {
  urban_nav_core::SweepMotionQueue<Sweep>::Options queue;
  queue.max_lateness = static_cast<urban_nav_core::StampNs>(std::llround(1e9 * options.max_lateness));
  queue.delivery = urban_nav_core::DeliveryOrder::OrderedStreams;
  queue.motion = options.motion;
  return queue;
}

}  // namespace

SweepInputs::SweepInputs(const Options& options, Listener listener)
    : options_(options),
      listener_(std::move(listener)),
      queue_options_(toQueueOptions(options)),
      queue_(queue_options_),
      wheels_(options.wheel_noise),
      rounds_(urban_nav_live::RoundGate<Item>::Options{{kSweepRound}},
              {[this](Item& item) { feed(item); }, [this] { end("time went back"); }}) {}

void SweepInputs::handle(const Message& message) {
  if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&message)) transforms_.add(**transforms);
  else if (const auto* cloud = std::get_if<sensor_msgs::PointCloud2ConstPtr>(&message)) add(*cloud);
  else if (const auto* scan = std::get_if<sensor_msgs::LaserScanConstPtr>(&message)) add(*scan);
  else if (const auto* imu = std::get_if<sensor_msgs::ImuConstPtr>(&message)) add(*imu);
  else if (const auto* odometry = std::get_if<nav_msgs::OdometryConstPtr>(&message))
    rounds_.add(kWheelRound, toStampNs((*odometry)->header.stamp), Item(*odometry));
}

bool SweepInputs::place(const std::string& frame) {
  if (frame != frame_) {
    if (!frame_.empty()) end("another LiDAR: frame " + frame);
    frame_ = frame;
    feed_.emplace(options_.clouds);
    scans_ = {};
  }
  const std::optional<Pose> place = transforms_.lookup(options_.base_frame, frame);
  if (place && T_base_sensor_ && !isApprox(*place, *T_base_sensor_, 0.0)) flush();
  if (place) T_base_sensor_ = place;
  return listener_.place(place, frame);
}

void SweepInputs::add(const sensor_msgs::LaserScanConstPtr& message) {
  if (!place(message->header.frame_id)) return;
  const std::optional<urban_nav_core::PlanarScan> scan = toPlanarScan(*message, {});
  listener_.fault(scan ? "" : "scans without a stamp or angles of beams");
  if (scan) add(scans_.read(*scan));
  else listener_.invalid("");
}

void SweepInputs::add(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  if (!place(cloud->header.frame_id)) return;
  std::vector<urban_nav_core::ReadSweep> sweeps = feed_->add(cloud);
  listener_.fault(feed_->fault());
  for (urban_nav_core::ReadSweep& read : sweeps) {
    if (read.fault.empty()) add(std::move(read.sweep));
    else listener_.invalid(read.fault);
  }
}

/// The axes of an IMU without transform are assumed to be those of the robot, as by the reader of recordings.
void SweepInputs::add(const sensor_msgs::ImuConstPtr& message) {
  const std::string& frame = message->header.frame_id;
  const std::optional<Pose> T_base_imu = transforms_.lookup(options_.base_frame, frame);
  const bool is_new = imu_frame_ != frame || T_base_imu.has_value() != T_base_imu_.has_value() ||
                      (T_base_imu && !isApprox(*T_base_imu, *T_base_imu_, 1e-9));
  if (is_new && !imu_frame_.empty()) end("the mounting of the gyroscope changed");
  imu_frame_ = frame;
  T_base_imu_ = T_base_imu;
  rounds_.add(kRateRound, toStampNs(message->header.stamp),
              Item(Rate{message, T_base_imu ? T_base_imu->R() : urban_nav_core::Matrix3d::Identity()}));
}

void SweepInputs::add(Sweep sweep) {
  const urban_nav_core::StampNs stamp = sweep.reference;
  rounds_.add(kSweepRound, stamp, Item(std::move(sweep)));
}

void SweepInputs::feed(Item& item) {
  std::optional<urban_nav_core::MotionInput> motion;
  if (auto* sweep = std::get_if<Sweep>(&item)) {
    const urban_nav_core::StampNs end = sweep->beams.empty() ? sweep->reference : sweep->beams.back().stamp;
    queue_.add(end, std::move(*sweep));
  } else if (const auto* message = std::get_if<nav_msgs::OdometryConstPtr>(&item)) {
    motion = wheels_.add(**message);
  } else {
    const Rate& rate = std::get<Rate>(item);
    if (!gyroscope_) gyroscope_.emplace(options_.gyro_noise, rate.R_base_imu);
    motion = gyroscope_->add(*rate.message);
  }
  if (motion) {
    ++inputs_;
    queue_.add(*motion);
  }
  deliver();
}

void SweepInputs::deliver() {
  while (const auto ready = queue_.take()) listener_.sweep(ready->sweep, ready->inputs);
}

void SweepInputs::flush() {
  queue_.finish();
  deliver();
  late_ += queue_.late();
  queue_ = Queue(queue_options_);
}

void SweepInputs::restart() {
  late_ += queue_.late();
  queue_ = Queue(queue_options_);
  wheels_ = WheelMotion(options_.wheel_noise);
  gyroscope_.reset();
}

void SweepInputs::end(const std::string& why) {
  flush();
  restart();
  listener_.ended(why);
}

void SweepInputs::addTo(urban_nav_live::StageReport& report) const {
  if (!imu_frame_.empty() && !T_base_imu_)
    report.warn("no static tf from " + options_.base_frame + " to " + imu_frame_ +
                ": the axes of the gyroscope are assumed to be those of the robot");
  const std::int64_t late = late_ + queue_.late();
  report.add("dropped: IMU or wheels too late", late);
  report.fault_counts.push_back(
      {"messages of IMU or wheels arrived too late", late, inputs_, "synchronise the clocks, or raise max_lateness"});
}

}  // namespace urban_nav_ros
