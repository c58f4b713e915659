// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <array>
#include <cstdint>

#include "convert/bag_writer.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

/// Measurements of the simulator as the messages and topics of DESIGN.md section 5.
class MeasurementTopics {
 public:
  /// Writes /tf_static at once. `bag` must outlive it.
  MeasurementTopics(const urban_nav_sim::Session& session, BagWriter& bag);

  void write(const urban_nav_sim::Measurement& measurement);

 private:
  void put(const urban_nav_sim::StereoMeasurement& pair);
  void put(const urban_nav_sim::LadybugMeasurement& panorama);
  void put(const urban_nav_sim::LaserMeasurement& turn);
  void put(const urban_nav_sim::ImuMeasurement& imu);
  void put(const urban_nav_sim::WheelMeasurement& wheels);
  void put(const urban_nav_sim::GpsMeasurement& gps);
  void put(const urban_nav_sim::TruthMeasurement& truth);

  BagWriter& bag_;
  sensor_msgs::CameraInfo left_, right_;
  std::array<sensor_msgs::CameraInfo, 5> ladybug_;
  std::array<std::uint32_t, 2> turns_{};
};

}  // namespace urban_nav
