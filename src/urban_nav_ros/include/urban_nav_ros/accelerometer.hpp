// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/inertial/accelerometer_check.hpp"
#include "urban_nav_core/types/specific_force.hpp"
#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_ros {

/// Converts imu/data to specific force in base_link axes, using the static tf of the frame in the first message, as
/// offline. Earlier messages wait for the tf. Messages without an accelerometer are ignored. Samples are withheld while
/// the mean of all samples contradicts the vertical of the mounting (AccelerometerCheck).
class Accelerometer {
 public:
  /// `convention`: of the messages.
  explicit Accelerometer(std::string base_frame, const urban_nav_core::AccelerometerConvention& convention = {})
      : base_frame_(std::move(base_frame)), convention_(convention) {}
  /// Creates a converter for a device of known mounting, which needs no tf.
  explicit Accelerometer(const urban_nav_core::Matrix3d& R_base_imu,
                         const urban_nav_core::AccelerometerConvention& convention = {})
      : convention_(convention), R_base_imu_(R_base_imu) {}
  /// Returns the samples that can be converted now, in the order of arrival.
  std::vector<urban_nav_core::SpecificForce> add(const sensor_msgs::Imu& message);
  std::vector<urban_nav_core::SpecificForce> add(const tf2_msgs::TFMessage& message);
  /// Returns the fault of the samples so far; no fault before the mounting is known. Thread-safe.
  urban_nav_core::AccelerometerVerdict verdict() const;
  /// Returns the number of withheld samples.
  std::int64_t withheld() const;
  /// Adds the state to a report: a warning if the accelerometer is not plausible. Thread-safe.
  void addTo(urban_nav_live::StageReport& report) const;
  /// Reads or writes the state between two messages, for a device of known mounting.
  void archive(urban_nav_core::Archive& archive) { archive(check_, withheld_); }

 private:
  struct Sample {
    urban_nav_core::SpecificForce force;  ///< in the axes of the device
    urban_nav_core::Vector3d rate;        ///< rad/s
  };
  std::vector<urban_nav_core::SpecificForce> takeConverted();

  const std::string base_frame_;
  const urban_nav_core::AccelerometerConvention convention_;
  StaticTransforms transforms_;
  std::optional<std::string> frame_;
  std::optional<urban_nav_core::Matrix3d> R_base_imu_;
  std::vector<Sample> waiting_;
  mutable std::mutex mutex_;  // guards R_base_imu_ and all members below
  urban_nav_core::AccelerometerCheck check_;
  std::int64_t withheld_ = 0;
  std::int64_t samples_ = 0, not_finite_ = 0;
};

}  // namespace urban_nav_ros
