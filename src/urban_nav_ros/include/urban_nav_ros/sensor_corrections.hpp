// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/Header.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/inertial/accelerometer_check.hpp"
#include "urban_nav_core/laser/scan_check.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_ros {

/// Conventions of drivers that differ from the definitions of their messages: parameters `input.imu_delay` etc. of
/// readers of recordings, `input/imu_delay` etc. of nodelets. Base of their parameter structs; the rows are those of
/// withSensorCorrections().
struct SensorCorrectionParameters {
  std::string accelerometer_axes;                                 // in the format of parseAxisMap()
  double accelerometer_scale;                                     // m/s2
  double gyroscope_scale;                                         // rad/s
  double wheels_scale;                                            // m
  double imu_delay, wheels_delay, gps_delay;                      // ms
  double laser_left_delay, laser_right_delay;                     // ms
  double laser_left_range_scale, laser_right_range_scale;         // m
  double laser_left_angle_scale, laser_right_angle_scale;         // rad
  double laser_left_time_scale, laser_right_time_scale;           // s
  double laser0_delay, laser1_delay, laser2_delay, laser3_delay;  // ms
  double laser0_range_scale, laser1_range_scale, laser2_range_scale, laser3_range_scale;  // m
  double laser0_angle_scale, laser1_angle_scale, laser2_angle_scale, laser3_angle_scale;  // rad
  double laser0_time_scale, laser1_time_scale, laser2_time_scale, laser3_time_scale;      // s
};

/// Corrections given by SensorCorrectionParameters.
struct SensorCorrections {
  urban_nav_core::AccelerometerConvention accelerometer = {};
  double gyroscope_scale = 1.0, wheels_scale = 1.0;
  urban_nav_core::StampNs imu_delay = 0, wheels_delay = 0, gps_delay = 0;  // ns
  std::array<urban_nav_core::LaserConvention, 6> lasers = {};              // left, right, laser0 ... laser3
};

/// Returns the corrections. Throws UserError for unknown axes and for a wheels_scale of zero.
SensorCorrections toCorrections(const SensorCorrectionParameters& parameters);

/// Subtracts a delay (ns) from a stamp. Returns false, without effect, if the result is not positive.
bool correctStamp(urban_nav_core::StampNs delay, std_msgs::Header& header);
/// Scale the rates of an IMU message, and the positions of a wheel odometry message.
void correctRates(double scale, sensor_msgs::Imu& imu);
void correctPositions(double scale, nav_msgs::Odometry& wheels);

/// Name and value of a parameter of SensorCorrectionParameters.
struct CorrectionSetting {
  std::string name, value;
};
/// Returns the settings that correct an accelerometer whose messages are read by the convention `present`; empty: none
/// does.
std::vector<CorrectionSetting> settingsFor(const urban_nav_core::AccelerometerVerdict& verdict,
                                           const urban_nav_core::AccelerometerConvention& present);
/// Returns the settings that correct the scans of a laser. `role`: "laser_left", "laser_right", "laser0" ....
std::vector<CorrectionSetting> settingsFor(const urban_nav_core::ScanVerdict& verdict, const std::string& role,
                                           const urban_nav_core::LaserConvention& present);

/// Returns the fault of the units of scans with its likely cause: "the median range is 4200 m: the ranges are in
/// millimetres"; empty: no fault.
std::string describeUnits(const urban_nav_core::ScanVerdict& verdict);

/// Returns the rows of SensorCorrectionParameters; `doctor` proposes a value for each in its findings.
template <typename P>
std::vector<urban_nav_core::Row<P>> sensorCorrectionRows();

/// Returns the rows `own` followed by those of SensorCorrectionParameters.
template <typename P>
std::vector<urban_nav_core::Row<P>> withSensorCorrections(std::vector<urban_nav_core::Row<P>> own) {
  for (auto& row : sensorCorrectionRows<P>()) own.push_back(std::move(row));
  return own;
}

constexpr double kLongestDelay = 1e13;  ///< ms: that of a clock that was never set

/// Returns the row of the delay of a sensor.
template <typename P>
urban_nav_core::Row<P> delayRow(const std::string& name, double P::*member, const std::string& what,
                                std::vector<std::string> old_names = {}) {
  return {name,
          member,
          "ms",
          0.0,
          -kLongestDelay,
          kLongestDelay,
          {},
          "Delay of the stamps of " + what + " relative to the measurement; subtracted from them.",
          "docs/files.md",
          std::move(old_names),
          urban_nav_core::Audience::Experts};
}

namespace detail {

template <typename P>
urban_nav_core::Row<P> scaleRow(const std::string& name, double P::*member, const char* unit, double low,
                                const std::string& sentence, std::vector<std::string> old_names = {}) {
  return {name,
          member,
          unit,
          1.0,
          low,
          1e6,
          {},
          sentence,
          "docs/files.md",
          std::move(old_names),
          urban_nav_core::Audience::Experts};
}

/// Parameters of one laser.
template <typename P>
struct LaserMembers {
  const char* laser;
  double P::*delay;
  double P::*range_scale;
  double P::*angle_scale;
  double P::*time_scale;
};

/// Returns the lasers in the order of SensorCorrections::lasers.
template <typename P>
std::array<LaserMembers<P>, 6> laserMembers() {
  return {{{"laser_left", &P::laser_left_delay, &P::laser_left_range_scale, &P::laser_left_angle_scale,
            &P::laser_left_time_scale},
           {"laser_right", &P::laser_right_delay, &P::laser_right_range_scale, &P::laser_right_angle_scale,
            &P::laser_right_time_scale},
           {"laser0", &P::laser0_delay, &P::laser0_range_scale, &P::laser0_angle_scale, &P::laser0_time_scale},
           {"laser1", &P::laser1_delay, &P::laser1_range_scale, &P::laser1_angle_scale, &P::laser1_time_scale},
           {"laser2", &P::laser2_delay, &P::laser2_range_scale, &P::laser2_angle_scale, &P::laser2_time_scale},
           {"laser3", &P::laser3_delay, &P::laser3_range_scale, &P::laser3_angle_scale, &P::laser3_time_scale}}};
}

template <typename P>
std::vector<urban_nav_core::Row<P>> laserRows(const LaserMembers<P>& of) {
  const std::string laser = of.laser;
  const auto old = [&laser](const std::string& what) {
    return laser == "laser0" ? std::vector<std::string>{"scan" + what} : std::vector<std::string>();
  };
  const auto scale = [&](const char* what, double P::*member, const char* unit, double low,
                         const std::string& sentence) {
    return scaleRow<P>(laser + what, member, unit, low, sentence, old(what));
  };
  return {delayRow<P>(laser + "_delay", of.delay, "scans of " + laser, old("_delay")),
          scale("_range_scale", of.range_scale, "m", 1e-6,
                "Range of one unit in the messages of " + laser + ": 0.001 for millimetres."),
          scale("_angle_scale", of.angle_scale, "rad", 1e-6,
                "Angle of one unit in the messages of " + laser + ": 0.0174532925 for degrees."),
          scale("_time_scale", of.time_scale, "s", 0.0,
                "One unit of time_increment in the messages of " + laser +
                    ": 0.001 for milliseconds; 0: all beams have the stamp of their scan.")};
}

}  // namespace detail

template <typename P>
std::vector<urban_nav_core::Row<P>> sensorCorrectionRows() {
  using detail::scaleRow;
  std::vector<urban_nav_core::Row<P>> rows = {
      {"accelerometer_axes",
       &P::accelerometer_axes,
       "",
       "x,y,z",
       false,
       false,
       {},
       "Axes of the IMU messages that are x, y and z of its accelerometer: -x,-y,-z for the sign of NED, y,z,x for "
       "exchanged axes.",
       "docs/files.md"},
      scaleRow<P>("accelerometer_scale", &P::accelerometer_scale, "m/s2", 1e-6,
                  "Specific force of one unit in the IMU messages: 9.80665 for g."),
      scaleRow<P>("gyroscope_scale", &P::gyroscope_scale, "rad/s", 1e-6,
                  "Rate of one unit in the IMU messages: 0.0174532925 for deg/s."),
      scaleRow<P>("wheels_scale", &P::wheels_scale, "m", -1e6,
                  "Distance of one unit in the positions of wheel odometry: 0.001 for millimetres, -1 if forward is "
                  "negative."),
      delayRow<P>("imu_delay", &P::imu_delay, "messages of the IMU"),
      delayRow<P>("wheels_delay", &P::wheels_delay, "messages of wheel odometry"),
      delayRow<P>("gps_delay", &P::gps_delay, "fixes of the GPS receiver")};
  for (const detail::LaserMembers<P>& laser : detail::laserMembers<P>())
    for (auto& row : detail::laserRows<P>(laser)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace urban_nav_ros
