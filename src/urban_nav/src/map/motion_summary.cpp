// SPDX-License-Identifier: BSD-3-Clause
#include "map/motion_summary.hpp"

#include <cmath>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

namespace {

std::string withSigma(double value, double sigma, const std::string& unit) {
  return urban_nav_core::formatNumber(value, 3) + " +- " + urban_nav_core::formatNumber(sigma, 2) + unit;
}

std::vector<std::string> describeSensor(const urban_nav_core::MotionEstimates& motion, bool is_wheels,
                                        const std::string& calibration, const std::string& delay) {
  const std::string fault = currentFault(motion, is_wheels);
  const bool is_used = is_wheels ? motion.uses_wheels : motion.uses_gyroscope;
  const std::string name = is_wheels ? "wheels" : "gyroscope";
  if (!fault.empty()) return {name, "left out: " + fault, "", ""};
  return {name, is_used ? "used" : "not used: no motion confirmed it", calibration, delay};
}

}  // namespace

std::optional<PageTable> motionTable(const urban_nav_core::MotionEstimates& motion) {
  if (!motion.has_gyroscope && !motion.has_wheels) return std::nullopt;
  PageTable table;
  table.title = "Motion sensors";
  table.head = {"sensor", "use", "calibration", "delay"};
  table.caption = "At the end of the session; delays on the clock of the odometry.";
  constexpr double kToDegrees = 180.0 / M_PI;
  if (motion.has_gyroscope)
    table.rows.push_back(describeSensor(motion, false,
                                        "bias " + withSigma(kToDegrees * motion.gyroscope_bias.norm(),
                                                            kToDegrees * motion.gyroscope_bias_sigma.norm(), " deg/s"),
                                        withSigma(1e3 * motion.imu_offset_s, 1e3 * motion.imu_offset_sigma_s, " ms")));
  if (motion.has_wheels)
    table.rows.push_back(describeSensor(
        motion, true, "measured over true speed " + withSigma(motion.wheel_scale, motion.wheel_scale_sigma, ""),
        withSigma(1e3 * motion.wheel_offset_s, 1e3 * motion.wheel_offset_sigma_s, " ms")));
  return table;
}

void addMotion(const urban_nav_core::MotionEstimates& motion, double scale_sigma, Json& json) {
  const auto list = [](const Eigen::Vector3d& values) {
    Json numbers = Json::array();
    for (Eigen::Index i = 0; i < 3; ++i) numbers.append(values[i]);
    return numbers;
  };
  if (motion.has_gyroscope && !motion.gyroscope_left_out) {
    json["gyroscope_bias_radps"] = list(motion.gyroscope_bias);
    json["gyroscope_bias_sigma_radps"] = list(motion.gyroscope_bias_sigma);
    json["imu_offset_s"] = motion.imu_offset_s;
    json["imu_offset_sigma_s"] = motion.imu_offset_sigma_s;
  }
  if (motion.has_wheels && !motion.wheels_left_out) {
    json["wheel_scale"] = motion.wheel_scale;
    json["wheel_scale_sigma"] = std::hypot(motion.wheel_scale_sigma, motion.wheel_scale * scale_sigma);
    json["wheel_turn_scale"] = motion.wheel_turn_scale;
    json["wheel_turn_scale_sigma"] = motion.wheel_turn_scale_sigma;
    json["wheel_offset_s"] = motion.wheel_offset_s;
    json["wheel_offset_sigma_s"] = motion.wheel_offset_sigma_s;
  }
}

void addMotionFaults(const urban_nav_core::MotionEstimates& motion, const std::string& input,
                     urban_nav_core::StampNs begin, std::vector<std::string>& warnings) {
  for (const urban_nav_core::MotionSensorFault& fault : motion.faults)
    warnings.push_back(input + ": " + describe(fault, begin));
}

}  // namespace urban_nav
