// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/frame.hpp"

#include <algorithm>

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace swf_vo {

using urban_nav_core::Archive;

void archive(Archive& archive, Feature& feature) {
  archive(feature.landmark, feature.pixel, feature.age, feature.trusted);
}

void archive(Archive& archive, Landmark& landmark) { archive(landmark.id, landmark.p_odom, landmark.sigma); }

void archive(Archive& archive, RigConstants& rig) {
  archive(rig.roll_rad, rig.roll_sigma_rad, rig.delay_s, rig.delay_sigma_s, rig.scale_sigma);
}

std::string describe(const MotionSensorFault& fault, urban_nav_core::StampNs begin) {
  const auto second = [&](urban_nav_core::StampNs stamp) {
    return urban_nav_core::formatNumber(urban_nav_core::secondsBetween(begin, stamp), 3);
  };
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

void archive(Archive& archive, Statistics& statistics) {
  archive(statistics.corners, statistics.features, statistics.tracked, statistics.track_length_mean);
  archive(statistics.reprojection_px, statistics.iterations, statistics.landmarks, statistics.landmarks_in_prior);
  archive(statistics.disparity_offset_px, statistics.disparity_offset_sigma_px, statistics.row_offset_px);
  archive(statistics.noise_scale);
}

void archive(Archive& archive, Settled& settled) {
  archive(settled.frame, settled.stamp, settled.T_odom_base, settled.from_previous, settled.status);
}

void archive(Archive& archive, Frame& frame) {
  archive(frame.frame, frame.stamp, frame.accepted, frame.T_odom_base, frame.velocity.twist, frame.velocity.covariance);
  archive(frame.rig.right_turn_rad);  // not in RigConstants, whose form stored runs have
  archive(frame.status, frame.statistics, frame.rig, frame.motion, frame.settled, frame.features, frame.landmarks);
}

}  // namespace swf_vo
