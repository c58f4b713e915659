// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/sensor_inputs.hpp"

#include <algorithm>
#include <array>
#include <boost/make_shared.hpp>
#include <optional>

#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_ros {

namespace {

constexpr std::array<const char*, 3> kLaserTopics = {{topics::kLaserLeft, topics::kLaserRight, topics::kScan}};
constexpr std::array<const char*, 3> kLaserNames = {{"laser_left", "laser_right", "laser0"}};

/// Returns the index of the laser of a topic, as in SensorCorrections; nullopt for other topics.
std::optional<std::size_t> findLaser(const std::string& topic) {
  const auto found = std::find(kLaserTopics.begin(), kLaserTopics.end(), topic);
  if (found == kLaserTopics.end()) return std::nullopt;
  return static_cast<std::size_t>(found - kLaserTopics.begin());
}

bool isIdentity(const urban_nav_core::LaserConvention& convention) {
  return convention.range_scale == 1.0 && convention.angle_scale == 1.0 && convention.delay == 0 &&
         convention.time_scale == 1.0;
}

}  // namespace

LiveCorrectionParameters::LiveCorrectionParameters() { liveCorrectionTable().setDefaults(*this); }

const urban_nav_core::Table<LiveCorrectionParameters>& liveCorrectionTable() {
  using P = LiveCorrectionParameters;
  static const urban_nav_core::Table<P> table(
      "input", withSensorCorrections<P>(
                   {{"right_delay",
                     &P::right_delay,
                     "ms",
                     0.0,
                     -1000.0,
                     1000.0,
                     {},
                     "Delay of the stamps of the right images relative to left images of the same exposure; "
                     "subtracted by stereo_rectify.",
                     "docs/files.md"}}));
  return table;
}

SensorInputs::SensorInputs(const ros::NodeHandle& nh)
    : SensorInputs(toCorrections(readParameters(ros::NodeHandle(nh, "input"), liveCorrectionTable()))) {}

sensor_msgs::ImuConstPtr SensorInputs::correct(const std::string& topic,
                                               const sensor_msgs::ImuConstPtr& message) const {
  if (topic != topics::kImu || (corrections_.imu_delay == 0 && corrections_.gyroscope_scale == 1.0)) return message;
  const auto corrected = boost::make_shared<sensor_msgs::Imu>(*message);
  if (!correctStamp(corrections_.imu_delay, corrected->header)) return nullptr;
  correctRates(corrections_.gyroscope_scale, *corrected);
  return corrected;
}

nav_msgs::OdometryConstPtr SensorInputs::correct(const std::string& topic,
                                                 const nav_msgs::OdometryConstPtr& message) const {
  if (topic != topics::kWheelOdometry || (corrections_.wheels_delay == 0 && corrections_.wheels_scale == 1.0))
    return message;
  const auto corrected = boost::make_shared<nav_msgs::Odometry>(*message);
  if (!correctStamp(corrections_.wheels_delay, corrected->header)) return nullptr;
  correctPositions(corrections_.wheels_scale, *corrected);
  return corrected;
}

sensor_msgs::NavSatFixConstPtr SensorInputs::correct(const std::string& topic,
                                                     const sensor_msgs::NavSatFixConstPtr& message) const {
  if (topic != topics::kGpsFix || corrections_.gps_delay == 0) return message;
  const auto corrected = boost::make_shared<sensor_msgs::NavSatFix>(*message);
  return correctStamp(corrections_.gps_delay, corrected->header) ? corrected : nullptr;
}

sensor_msgs::LaserScanConstPtr SensorInputs::correct(const std::string& topic,
                                                     const sensor_msgs::LaserScanConstPtr& message) const {
  const std::optional<std::size_t> laser = findLaser(topic);
  if (!laser) return message;
  const urban_nav_core::LaserConvention& convention = corrections_.lasers[*laser];
  const urban_nav_core::ScanVerdict verdict = checkUnits(*message, convention);
  std::string fault;
  if (verdict.fault != urban_nav_core::ScanFault::None) {
    fault = topic + " is not used: " + describeUnits(verdict);
    for (const auto& setting : settingsFor(verdict, kLaserNames[*laser], convention))
      fault += "; repair the driver, or set input/" + setting.name + " to " + setting.value + " and start again";
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    faults_[topic] = fault;
  }
  if (isIdentity(convention)) return message;
  const auto scan = toPlanarScan(*message, convention);
  if (!scan || scan->stamp <= 0) return nullptr;
  auto corrected = boost::make_shared<sensor_msgs::LaserScan>(toLaserScanMessage(*scan, message->header.frame_id));
  corrected->header.seq = message->header.seq;
  return corrected;
}

std::vector<std::string> SensorInputs::faults() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> faults;
  for (const auto& [topic, fault] : faults_)
    if (!fault.empty()) faults.push_back(fault);
  return faults;
}

}  // namespace urban_nav_ros
