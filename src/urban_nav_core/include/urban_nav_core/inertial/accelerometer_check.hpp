// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_core {

/// Conversion from message values to the specific force in the axes of the device: scale * axes * measured.
struct AccelerometerConvention {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< as returned by parseAxisMap()
  double scale = 1.0;                                  ///< m/s2 per unit of the messages
};
/// Defect of the accelerations of a recording.
enum class AccelerometerFault {
  None,
  NotFinite,  ///< no finite measurement
  NoGravity,  ///< the device subtracts gravity
  Unit,       ///< other units than m/s2
  Size,       ///< neither m/s2 nor another usual unit
  Direction,  ///< other axes or another sign
};
const char* toString(AccelerometerFault fault);

/// Fault of an accelerometer, and the convention that corrects it.
struct AccelerometerVerdict {
  AccelerometerFault fault = AccelerometerFault::None;
  double angle = 0.0;                              ///< rad between the mean specific force and up
  double size = 0.0;                               ///< m/s2: mean length of the specific force
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< m/s2, in the axes of the device
  std::optional<AccelerometerConvention> repair;   ///< to be applied after the present convention; empty: no known
                                                   ///< convention fits
  bool sound() const { return fault == AccelerometerFault::None; }
  /// Returns the fault with its numbers and likely cause; empty for a plausible accelerometer.
  std::string sentence() const;
};

/// Compares the measured specific force with the vertical in the device frame: at rest, and on average over a drive,
/// the force is 9.81 m/s2 upwards (sensor_msgs/Imu). Old measurements lose weight after some minutes, so that a device
/// that changes is assessed by its present output. Not thread-safe.
class AccelerometerCheck {
 public:
  /// Adds a measurement. `force`: m/s2 in the axes of the device. `rate`: angular rate, rad/s; not finite: unavailable.
  void add(const Eigen::Vector3d& force, const Eigen::Vector3d& rate);
  /// Returns the verdict. `up`: unit vector against gravity in the axes of the device, from its mounting. `left`: unit
  /// vector to the left of the vehicle, in the same axes. The lateral force in turns, which has the sign of the yaw
  /// rate, distinguishes conventions with the same vertical. No fault without measurements, nor if the device rotated
  /// too much for a mean direction.
  AccelerometerVerdict verdict(const Eigen::Vector3d& up, const Eigen::Vector3d& left) const;
  /// Returns whether verdict() has no fault, at the cost of a few products.
  bool isPlausible(const Eigen::Vector3d& up) const;
  /// Returns how many measurements were added, finite or not.
  std::int64_t count() const { return count_; }
  void archive(Archive& archive) {
    archive(count_, finite_, weight_, length_, force_, rate_, force_rate_, force_force_, rate_rate_, rate_weight_);
  }

 private:
  AccelerometerFault findFault(const Eigen::Vector3d& up) const;
  AccelerometerConvention bestAxes(const Eigen::Vector3d& up, const Eigen::Vector3d& left) const;

  std::int64_t count_ = 0, finite_ = 0;
  double weight_ = 0.0, length_ = 0.0, rate_weight_ = 0.0;                            // sums of weights and of lengths
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero(), rate_ = Eigen::Vector3d::Zero();  // weighted sums
  Eigen::Matrix3d force_rate_ = Eigen::Matrix3d::Zero(), force_force_ = Eigen::Matrix3d::Zero(),
                  rate_rate_ = Eigen::Matrix3d::Zero();  // sums of outer products
};

}  // namespace urban_nav_core
