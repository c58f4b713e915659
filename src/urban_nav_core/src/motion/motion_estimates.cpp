// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/motion_estimates.hpp"

#include <algorithm>

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_core {

std::string describe(const MotionSensorFault& fault, StampNs begin) {
  const auto second = [&](StampNs stamp) { return formatNumber(secondsBetween(begin, stamp), 3); };
  return std::string(fault.is_wheels ? "wheels" : "IMU: gyroscope") + " not used from " + second(fault.since) +
         (fault.until > 0 ? " s to " + second(fault.until) + " s" : " s on") + ": " + fault.sentence;
}

std::string currentFault(const MotionEstimates& motion, bool is_wheels) {
  if (is_wheels ? !motion.wheels_left_out : !motion.gyroscope_left_out) return "";
  const auto fault = std::find_if(motion.faults.rbegin(), motion.faults.rend(),
                                  [&](const MotionSensorFault& each) { return each.is_wheels == is_wheels; });
  return fault == motion.faults.rend() ? "" : fault->sentence;
}

void archive(Archive& archive, MotionSensorFault& fault) {
  archive(fault.is_wheels, fault.is_named, fault.since, fault.until, fault.sentence);
}

void archive(Archive& archive, MotionEstimates& motion) {
  archive(motion.has_gyroscope, motion.uses_gyroscope, motion.gyroscope_left_out);
  archive(motion.has_wheels, motion.uses_wheels, motion.wheels_left_out);
  archive(motion.gyroscope_bias, motion.gyroscope_bias_sigma, motion.imu_offset_s, motion.imu_offset_sigma_s);
  archive(motion.wheel_scale, motion.wheel_scale_sigma, motion.wheel_turn_scale, motion.wheel_turn_scale_sigma);
  archive(motion.wheel_offset_s, motion.wheel_offset_sigma_s, motion.faults);
}

}  // namespace urban_nav_core
