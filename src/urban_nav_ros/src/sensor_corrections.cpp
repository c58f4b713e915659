// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/sensor_corrections.hpp"

#include <cmath>

#include "urban_nav_core/inertial/axis_map.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;

SensorCorrections toCorrections(const SensorCorrectionParameters& parameters) {
  const auto toNs = [](double ms) { return static_cast<StampNs>(std::llround(1e6 * ms)); };
  const auto axes = urban_nav_core::parseAxisMap(parameters.accelerometer_axes);
  if (!axes)
    throw UserError("input.accelerometer_axes", "\"" + parameters.accelerometer_axes + "\"",
                    "x, y and z in any order, each with or without a minus, such as -x,-y,-z");
  if (parameters.wheels_scale == 0.0) throw UserError("input.wheels_scale", "0", "a factor other than 0");
  SensorCorrections corrections;
  corrections.accelerometer = {*axes, parameters.accelerometer_scale};
  corrections.gyroscope_scale = parameters.gyroscope_scale;
  corrections.wheels_scale = parameters.wheels_scale;
  corrections.imu_delay = toNs(parameters.imu_delay);
  corrections.wheels_delay = toNs(parameters.wheels_delay);
  corrections.gps_delay = toNs(parameters.gps_delay);
  const auto members = detail::laserMembers<SensorCorrectionParameters>();
  for (std::size_t i = 0; i < members.size(); ++i)
    corrections.lasers[i] = {parameters.*members[i].range_scale, parameters.*members[i].angle_scale,
                             toNs(parameters.*members[i].delay), parameters.*members[i].time_scale};
  return corrections;
}

bool correctStamp(StampNs delay, std_msgs::Header& header) {
  if (delay == 0) return true;
  const StampNs stamp = toStampNs(header.stamp) - delay;
  if (stamp <= 0) return false;
  header.stamp = toRosTime(stamp);
  return true;
}

void correctRates(double scale, sensor_msgs::Imu& imu) {
  auto& rate = imu.angular_velocity;
  rate.x *= scale, rate.y *= scale, rate.z *= scale;
}

void correctPositions(double scale, nav_msgs::Odometry& wheels) {
  auto& p = wheels.pose.pose.position;
  p.x *= scale, p.y *= scale, p.z *= scale;
}

std::vector<CorrectionSetting> settingsFor(const urban_nav_core::AccelerometerVerdict& verdict,
                                           const urban_nav_core::AccelerometerConvention& present) {
  std::vector<CorrectionSetting> settings;
  if (verdict.sound() || !verdict.repair) return settings;
  const Eigen::Matrix3d axes = verdict.repair->axes * present.axes;
  const double scale = verdict.repair->scale * present.scale;
  if (axes != present.axes) settings.push_back({"accelerometer_axes", urban_nav_core::printAxisMap(axes)});
  if (scale != present.scale) settings.push_back({"accelerometer_scale", urban_nav_core::printNumber(scale)});
  return settings;
}

std::vector<CorrectionSetting> settingsFor(const urban_nav_core::ScanVerdict& verdict, const std::string& role,
                                           const urban_nav_core::LaserConvention& present) {
  if (verdict.fault == urban_nav_core::ScanFault::None || verdict.repair == 1.0) return {};
  const bool is_angle = verdict.fault == urban_nav_core::ScanFault::AngleUnit;
  return {{role + (is_angle ? "_angle_scale" : "_range_scale"),
           urban_nav_core::printNumber(verdict.repair * (is_angle ? present.angle_scale : present.range_scale))}};
}

std::string describeUnits(const urban_nav_core::ScanVerdict& verdict) {
  using urban_nav_core::formatNumber;
  using urban_nav_core::ScanFault;
  if (verdict.fault == ScanFault::None) return "";
  if (verdict.fault == ScanFault::AngleUnit)
    return "the beams span " + formatNumber(verdict.value, 4) + " rad, more than a turn (2 pi)" +
           (verdict.repair != 1.0 ? ": the angles are in degrees" : "");
  const std::string median = "the median range is " + formatNumber(verdict.value, 4) + " m";
  if (verdict.repair == 0.001) return median + ": the ranges are in millimetres";
  if (verdict.repair != 0.01) return median + ", farther than any planar laser measures";
  return median + ": the ranges are in centimetres (in millimetres the median would be " +
         formatNumber(0.001 * verdict.value, 3) + " m)";
}

}  // namespace urban_nav_ros
