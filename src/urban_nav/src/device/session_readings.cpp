// SPDX-License-Identifier: BSD-3-Clause
#include "device/session_readings.hpp"

#include <cmath>
#include <map>
#include <variant>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

constexpr double kFieldUnit = 50e-6;  // T, about 1 unit of an MTi

std::array<double, 3> toArray(const Eigen::Vector3d& v, double unit = 1.0) {
  return {v.x() / unit, v.y() / unit, v.z() / unit};
}

/// Collects the measurements of one device.
class ReadingCollector {
 public:
  ReadingCollector(std::string side) : side_(std::move(side)) {}

  void operator()(const urban_nav_sim::LaserMeasurement& laser) {
    if ((laser.side == urban_nav_sim::Side::Left) != (side_ == "left")) return;
    readings.lasers.push_back({since(laser.scan.stamp), laser.scan.ranges, laser.scan.intensities});
  }
  void operator()(const urban_nav_sim::ImuMeasurement& imu) {
    urban_nav_sim::ImuReading reading;
    reading.time = since(imu.stamp);
    reading.acceleration = toArray(imu.specific_force);
    reading.rate = toArray(imu.rate);
    reading.field = toArray(imu.field, kFieldUnit);
    readings.imu.push_back(reading);
  }
  void operator()(const urban_nav_sim::WheelMeasurement& wheels) {
    readings.wheels.push_back({since(wheels.stamp), wheels.speed, wheels.yaw_rate});
  }
  void operator()(const urban_nav_sim::GpsMeasurement& gps) {
    urban_nav_sim::GpsReading reading;
    if (readings.gps.empty()) readings.gps_begin = 1e-9 * static_cast<double>(gps.stamp);
    reading.time = since(gps.stamp);
    reading.valid = gps.has_fix;
    reading.latitude = gps.latitude;
    reading.longitude = gps.longitude;
    reading.height = gps.altitude;
    reading.sigma = gps.sigma[0];
    reading.speed = std::hypot(gps.velocity[0], gps.velocity[1]);
    reading.track =
        std::fmod(std::atan2(gps.velocity[0], gps.velocity[1]) * 180.0 / 3.14159265358979323846 + 360.0, 360.0);
    readings.gps.push_back(reading);
  }
  template <typename Other>
  void operator()(const Other&) {}

  urban_nav_sim::DeviceReadings readings;

 private:
  double since(urban_nav_core::StampNs stamp) {
    if (!first_) first_ = stamp;
    return 1e-9 * static_cast<double>(stamp - *first_);
  }

  std::string side_;
  std::optional<urban_nav_core::StampNs> first_;
};

}  // namespace

urban_nav_sim::DeviceReadings simulateReadings(urban_nav_sim::SessionOptions options, const std::string& kind,
                                               const std::string& side) {
  static const std::map<std::string, urban_nav_sim::Sensor> sensors = {{"lms291", urban_nav_sim::Sensor::Lasers},
                                                                       {"xsens_mti", urban_nav_sim::Sensor::Imu},
                                                                       {"segway_rmp", urban_nav_sim::Sensor::Wheels},
                                                                       {"gps", urban_nav_sim::Sensor::Gps}};
  const auto sensor = sensors.find(kind);
  if (sensor == sensors.end()) throw urban_nav_core::UserError("KIND", kind, "lms291, xsens_mti, segway_rmp, gps");
  options.sensors = {sensor->second};
  urban_nav_sim::Session session(options);
  ReadingCollector collector(side);
  while (const auto arrival = session.next()) std::visit(collector, arrival->measurement);
  return std::move(collector.readings);
}

}  // namespace urban_nav
