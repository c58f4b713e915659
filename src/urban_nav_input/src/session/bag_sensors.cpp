// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_sensors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "urban_nav_input/sensors/accelerometer_finding.hpp"
#include "urban_nav_input/sensors/ground_finding.hpp"
#include "urban_nav_input/sensors/place_finding.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::SpecificForce;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

namespace {

constexpr std::array<Role, 6> kLaserRoles = {
    {Role::LaserLeft, Role::LaserRight, Role::Laser0, Role::Laser1, Role::Laser2, Role::Laser3}};  // as sensors.lasers

/// Returns the index of the role in kLaserRoles.
std::size_t laserIndex(const std::string& role) {
  std::size_t index = 0;
  while (index + 1 < kLaserRoles.size() && role != toString(kLaserRoles[index])) ++index;
  return index;
}

}  // namespace

void BagSensors::addLaser(const std::string& topic, const std::string& frame,
                          const urban_nav_core::Pose& T_base_laser) {
  Role role = Role::LaserLeft;
  for (const Role each : kLaserRoles)
    if (const std::optional<ChosenTopic> chosen = topics_.find(each); chosen && chosen->name == topic) role = each;
  laser_topics_.push_back(topic);
  laser_places_.emplace_back(frame, T_base_laser);
  lasers_.emplace_back(toString(role), topic, options_.sensors.lasers[laserIndex(toString(role))]);
}

void BagSensors::addSweep(const std::string& topic, StampNs reference, StampNs receipt) {
  for (std::size_t i = 0; i < kPointsTopics; ++i)
    if (const auto chosen = topics_.find(pointsRole(i)); chosen && chosen->name == topic)
      clocks_.add(toString(pointsRole(i)), topic, reference, receipt);
}

bool BagSensors::add(sensor_msgs::Imu& imu, const std::string& topic, StampNs receipt) {
  if (!urban_nav_ros::correctStamp(options_.sensors.imu_delay, imu.header)) return false;
  const StampNs stamp = urban_nav_ros::toStampNs(imu.header.stamp);
  clocks_.add(toString(Role::Imu), topic, stamp, receipt);
  auto &force = imu.linear_acceleration, &rate = imu.angular_velocity;
  imu_.add(stamp, {{force.x, force.y, force.z, rate.x, rate.y, rate.z}});
  urban_nav_ros::correctRates(options_.sensors.gyroscope_scale, imu);
  if (R_base_imu_)
    motion_.addGyroscope(stamp, R_base_imu_->row(2).dot(urban_nav_core::Vector3d(rate.x, rate.y, rate.z)));
  if (accelerometer_)
    for (const SpecificForce& sample : accelerometer_->add(imu)) forces_.push_back(sample);
  return true;
}

bool BagSensors::add(nav_msgs::Odometry& wheels, const std::string& topic, StampNs receipt) {
  if (!urban_nav_ros::correctStamp(options_.sensors.wheels_delay, wheels.header)) return false;
  const StampNs stamp = urban_nav_ros::toStampNs(wheels.header.stamp);
  clocks_.add(toString(Role::Wheels), topic, stamp, receipt);
  auto& p = wheels.pose.pose.position;
  const auto& q = wheels.pose.pose.orientation;
  const auto& twist = wheels.twist.twist;
  wheels_.add(stamp, {{p.x, p.y, q.z, q.w, twist.linear.x, twist.angular.z}});
  urban_nav_ros::correctPositions(options_.sensors.wheels_scale, wheels);
  const double yaw = std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
  motion_.addWheels(stamp, {{p.x, p.y, yaw}}, twist.linear.x);
  return true;
}

void BagSensors::add(const sensor_msgs::NavSatFix& fix, const std::string& topic, StampNs receipt) {
  gps_.add(fix);
  sensor_msgs::NavSatFix corrected = fix;
  if (urban_nav_ros::correctStamp(options_.sensors.gps_delay, corrected.header))
    clocks_.add(toString(Role::Gps), topic, urban_nav_ros::toStampNs(corrected.header.stamp), receipt);
}

std::optional<urban_nav_core::PlanarScan> BagSensors::read(std::size_t laser, const sensor_msgs::LaserScan& message,
                                                           StampNs receipt) {
  LaserExamination& examination = lasers_[laser];
  std::optional<urban_nav_core::PlanarScan> scan = examination.read(message);
  if (!scan) return scan;
  clocks_.add(examination.role(), laser_topics_[laser], scan->stamp, receipt);
  if (laser < laser_grounds_.size()) laser_grounds_[laser].add(*scan, laser_places_[laser].second);
  if (laser_places_.size() == exchanged_grounds_.size())
    exchanged_grounds_[laser].add(*scan, laser_places_[1 - laser].second);
  return scan;
}

std::vector<SpecificForce> BagSensors::forces() const {
  return accelerometer_ && accelerometer_->verdict().sound() ? forces_ : std::vector<SpecificForce>();
}

std::optional<double> BagSensors::findDelay(const std::string& role) const {
  const urban_nav_ros::SensorCorrections& sensors = options_.sensors;
  const std::array<std::pair<Role, StampNs>, 3> delays = {
      {{Role::Imu, sensors.imu_delay}, {Role::Wheels, sensors.wheels_delay}, {Role::Gps, sensors.gps_delay}}};
  for (const auto& [of, delay] : delays)
    if (role == toString(of)) return 1e-6 * static_cast<double>(delay);
  for (std::size_t i = 0; i < kLaserRoles.size(); ++i)
    if (role == toString(kLaserRoles[i])) return 1e-6 * static_cast<double>(sensors.lasers[i].delay);
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
    append(accelerometerFindings(topics_.find(Role::Imu)->name, accelerometer_->verdict(),
                                 options_.sensors.accelerometer));
  for (const LaserExamination& laser : lasers_) append(laser.findings());
  if (const std::optional<ChosenTopic> imu = topics_.find(Role::Imu))
    append(imu_.findings(imu->name, FindingKind::Imu, true));
  if (const std::optional<ChosenTopic> wheels = topics_.find(Role::Wheels))
    append(wheels_.findings(wheels->name, FindingKind::Wheels, false));
  if (const std::optional<ChosenTopic> gps = topics_.find(Role::Gps)) append(gps_.findings(gps->name));
  append(clocks_.findings([this](const std::string& role) { return findDelay(role); }));
  return findings;
}

std::vector<Finding> BagSensors::sightFindings(const Sight& sight, double stereo_scale, bool is_camera_placed) const {
  const auto name = [this](Role role) {
    const std::optional<ChosenTopic> topic = topics_.find(role);
    return topic ? topic->name : std::string();
  };
  std::vector<SeenMotion> motions = sight.motions;
  for (SeenMotion& motion : motions)
    motion.T_from_to = urban_nav_core::Pose(motion.T_from_to.q(), stereo_scale * motion.T_from_to.t());
  std::vector<Finding> findings = motion_.findings(motions, name(Role::Wheels), name(Role::Imu), options_.sensors);
  if (!is_camera_placed) return findings;
  std::vector<double> heights;
  for (const SeenGround& ground : sight.grounds)
    heights.push_back((ground.up.dot(sight.camera) - stereo_scale * ground.drop) / ground.up.z());
  for (Finding& finding : laserGroundFindings(heights)) findings.push_back(std::move(finding));
  if (!accelerometer_ || !accelerometer_->verdict().sound()) return findings;
  Vector3d force = Vector3d::Zero();
  for (const SpecificForce& sample : forces_) force += sample.force;
  for (Finding& finding : groundFindings(name(Role::Imu), sight.grounds, force)) findings.push_back(std::move(finding));
  return findings;
}

std::vector<Finding> BagSensors::laserGroundFindings(const std::vector<double>& stereo) const {
  if (areExchanged(laser_grounds_, exchanged_grounds_, stereo)) {
    Finding finding{
        FindingKind::Lasers,
        laser_topics_[0] + " and " + laser_topics_[1] +
            " are exchanged: the ground measured by each laser agrees with stereo at the mounting of the other one",
        "--transform with their mountings exchanged; for later recordings exchange the cables, the ports or "
        "the names of the two lasers"};
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
      for (std::string& option : placeOptions(laser_places_[i].first, laser_places_[1 - i].second))
        finding.options.push_back(std::move(option));
    return {finding};
  }
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < std::min(lasers_.size(), laser_grounds_.size()); ++i) {
    const double range_scale = options_.sensors.lasers[laserIndex(lasers_[i].role())].range_scale;
    if (auto finding = laser_grounds_[i].finding(lasers_[i].role(), laser_topics_[i], stereo, range_scale))
      findings.push_back(std::move(*finding));
  }
  return findings;
}

void BagSensors::archive(urban_nav_core::Archive& archive) {
  std::vector<std::pair<StampNs, urban_nav_core::Vector3d>> forces;
  for (const SpecificForce& sample : forces_) forces.emplace_back(sample.stamp, sample.force);
  archive(forces, imu_, wheels_, gps_, clocks_, motion_);
  if (accelerometer_) archive(*accelerometer_);
  for (LaserExamination& laser : lasers_) archive(laser);
  for (LaserGround& ground : laser_grounds_) archive(ground);
  for (LaserGround& ground : exchanged_grounds_) archive(ground);
  if (!archive.isReading()) return;
  forces_.clear();
  for (const auto& [stamp, force] : forces) forces_.push_back({stamp, force});
}

}  // namespace urban_nav_input
