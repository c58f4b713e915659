// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_sensors.hpp"

#include <cmath>

#include "urban_nav_input/sensors/accelerometer_finding.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::SpecificForce;
using urban_nav_core::StampNs;

void BagSensors::addLaser(const std::string& topic) {
  const std::optional<ChosenTopic> right = topics_.find(Role::LaserRight);
  const bool is_right = right && right->name == topic;
  laser_topics_.push_back(topic);
  lasers_.emplace_back(toString(is_right ? Role::LaserRight : Role::LaserLeft), topic,
                       options_.lasers[is_right ? 1 : 0]);
}

void BagSensors::addSweep(const std::string& topic, StampNs reference, StampNs receipt) {
  for (std::size_t i = 0; i < kPointsTopics; ++i)
    if (const auto chosen = topics_.find(pointsRole(i)); chosen && chosen->name == topic)
      clocks_.add(toString(pointsRole(i)), topic, reference, receipt);
}

void BagSensors::add(sensor_msgs::Imu& imu, const std::string& topic, StampNs receipt) {
  StampNs stamp = urban_nav_ros::toStampNs(imu.header.stamp);
  if (options_.imu_delay != 0.0) {
    stamp -= static_cast<StampNs>(std::llround(1e6 * options_.imu_delay));
    if (stamp <= 0) return;
    imu.header.stamp = urban_nav_ros::toRosTime(stamp);
  }
  clocks_.add(toString(Role::Imu), topic, stamp, receipt);
  const auto &force = imu.linear_acceleration, &rate = imu.angular_velocity;
  imu_.add(stamp, {{force.x, force.y, force.z, rate.x, rate.y, rate.z}});
  if (!accelerometer_) return;
  for (const SpecificForce& sample : accelerometer_->add(imu)) forces_.push_back(sample);
}

void BagSensors::add(const nav_msgs::Odometry& wheels, const std::string& topic, StampNs receipt) {
  const StampNs stamp = urban_nav_ros::toStampNs(wheels.header.stamp);
  clocks_.add(toString(Role::Wheels), topic, stamp, receipt);
  const auto& p = wheels.pose.pose.position;
  const auto& q = wheels.pose.pose.orientation;
  wheels_.add(stamp, {{p.x, p.y, q.z, q.w, wheels.twist.twist.linear.x, wheels.twist.twist.angular.z}});
}

std::optional<urban_nav_core::PlanarScan> BagSensors::read(std::size_t laser, const sensor_msgs::LaserScan& message,
                                                           StampNs receipt) {
  LaserExamination& examination = lasers_[laser];
  std::optional<urban_nav_core::PlanarScan> scan = examination.read(message);
  if (scan) clocks_.add(examination.role(), laser_topics_[laser], scan->stamp, receipt);
  return scan;
}

std::vector<SpecificForce> BagSensors::forces() const {
  return accelerometer_ && accelerometer_->verdict().sound() ? forces_ : std::vector<SpecificForce>();
}

std::optional<double> BagSensors::findDelay(const std::string& role) const {
  if (role == toString(Role::Imu)) return options_.imu_delay;
  if (role == toString(Role::LaserLeft)) return 1e-6 * static_cast<double>(options_.lasers[0].delay);
  if (role == toString(Role::LaserRight)) return 1e-6 * static_cast<double>(options_.lasers[1].delay);
  for (std::size_t i = 0; i < options_.points.delays.size(); ++i)
    if (role == toString(pointsRole(i))) return options_.points.delays[i];
  return std::nullopt;
}

std::vector<Finding> BagSensors::findings() const {
  std::vector<Finding> findings = findings_;
  const auto append = [&](const std::vector<Finding>& more) {
    findings.insert(findings.end(), more.begin(), more.end());
  };
  if (accelerometer_)
    append(accelerometerFindings(topics_.find(Role::Imu)->name, accelerometer_->verdict(), options_.accelerometer));
  for (const LaserExamination& laser : lasers_) append(laser.findings());
  if (const std::optional<ChosenTopic> imu = topics_.find(Role::Imu))
    append(imu_.findings(imu->name, FindingKind::Imu, true));
  if (const std::optional<ChosenTopic> wheels = topics_.find(Role::Wheels))
    append(wheels_.findings(wheels->name, FindingKind::Wheels, false));
  if (const std::optional<ChosenTopic> gps = topics_.find(Role::Gps)) append(gps_.findings(gps->name));
  append(clocks_.findings([this](const std::string& role) { return findDelay(role); }));
  return findings;
}

void BagSensors::archive(urban_nav_core::Archive& archive) {
  std::vector<std::pair<StampNs, urban_nav_core::Vector3d>> forces;
  for (const SpecificForce& sample : forces_) forces.emplace_back(sample.stamp, sample.force);
  archive(forces, imu_, wheels_, gps_, clocks_);
  if (accelerometer_) archive(*accelerometer_);
  for (LaserExamination& laser : lasers_) archive(laser);
  if (!archive.isReading()) return;
  forces_.clear();
  for (const auto& [stamp, force] : forces) forces_.push_back({stamp, force});
}

}  // namespace urban_nav_input
