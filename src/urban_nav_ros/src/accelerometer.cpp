// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/accelerometer.hpp"

#include <utility>

#include "urban_nav_ros/sensor_corrections.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_ros {

using urban_nav_core::SpecificForce;

namespace {

// Capacity without tf: ten minutes at 100 Hz.
constexpr std::size_t kMostWaiting = 60'000;

}  // namespace

std::vector<SpecificForce> Accelerometer::add(const sensor_msgs::Imu& message) {
  if (!frame_) frame_ = message.header.frame_id;
  // sensor_msgs/Imu: element 0 is -1 without an accelerometer.
  if (message.linear_acceleration_covariance[0] < 0.0 || waiting_.size() >= kMostWaiting) return {};
  const auto& force = message.linear_acceleration;
  const auto& rate = message.angular_velocity;
  const urban_nav_core::Vector3d measured(force.x, force.y, force.z);
  waiting_.push_back(
      {{toStampNs(message.header.stamp), convention_.scale * (convention_.axes * measured)}, {rate.x, rate.y, rate.z}});
  return takeConverted();
}

std::vector<SpecificForce> Accelerometer::add(const tf2_msgs::TFMessage& message) {
  transforms_.add(message);
  return takeConverted();
}

std::vector<SpecificForce> Accelerometer::takeConverted() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!R_base_imu_ && frame_)
    if (const auto T_base_imu = transforms_.lookup(base_frame_, *frame_)) R_base_imu_ = T_base_imu->R();
  if (!R_base_imu_) return {};
  std::vector<SpecificForce> converted;
  for (const Sample& sample : std::exchange(waiting_, {})) {
    check_.add(sample.force.force, sample.rate);
    ++samples_;
    if (!sample.force.force.allFinite() || !sample.rate.allFinite()) ++not_finite_;
    if (!sample.force.force.allFinite()) continue;
    if (check_.isPlausible(R_base_imu_->transpose().col(2)))
      converted.push_back({sample.force.stamp, *R_base_imu_ * sample.force.force});
    else ++withheld_;
  }
  return converted;
}

urban_nav_core::AccelerometerVerdict Accelerometer::verdict() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!R_base_imu_) return {};
  return check_.verdict(R_base_imu_->transpose().col(2), R_base_imu_->transpose().col(1));
}

std::int64_t Accelerometer::withheld() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return withheld_;
}

void Accelerometer::addTo(urban_nav_live::StageReport& report) const {
  const urban_nav_core::AccelerometerVerdict now = verdict();
  const std::string fault = now.sentence();
  const std::vector<CorrectionSetting> settings = settingsFor(now, convention_);
  report.add("accelerometer", fault.empty() ? "plausible or absent" : fault);
  report.add("specific forces not used", withheld());
  const std::lock_guard<std::mutex> lock(mutex_);
  report.fault_counts.push_back({std::string("measurements on ") + topics::kImu + " were not finite", not_finite_,
                                 samples_, "check the inertial unit and its driver"});
  if (fault.empty()) return;
  std::string sentence = std::string(topics::kImu) + " is not used: " + fault;
  for (const CorrectionSetting& setting : settings)
    sentence += "; repair the driver, or set input/" + setting.name + " to " + setting.value + " and start again";
  report.warn(sentence);
}

}  // namespace urban_nav_ros
