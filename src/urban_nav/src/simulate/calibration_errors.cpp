// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/calibration_errors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr double kMostLag = 10.0;  // s
constexpr const char* kHead = "ladybug";
constexpr int kHeadCameras = 5;
constexpr const char* kDevices = "laser_left, laser_right, panorama, lidar3d, imu, wheels";

/// Returns the device of a topic; empty for other topics.
std::string lagDevice(const std::string& topic) {
  const std::string first = topic.substr(0, topic.find('/'));
  if (first == "ladybug") return "panorama";
  if (first == urban_nav_ros::topics::kPoints) return "lidar3d";
  return first == urban_nav_ros::topics::kWheelOdometry ? "wheels" : first;
}

/// Splits text at the last colon.
std::optional<std::pair<std::string, std::string>> atColon(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  return std::pair(text.substr(0, colon), text.substr(colon + 1));
}

std::optional<Eigen::Vector3d> parseAngles(const std::string& text) {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  std::size_t begin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t end = axis < 2 ? text.find(',', begin) : text.size();
    if (end == std::string::npos) return std::nullopt;
    const auto value = urban_nav_core::parseNumber(text.substr(begin, end - begin));
    if (!value || !(std::abs(*value) <= 180.0)) return std::nullopt;
    angles(axis) = *value * M_PI / 180.0;
    begin = end + 1;
  }
  return angles;
}

Eigen::Quaterniond rotationOf(const geometry_msgs::TransformStamped& transform) {
  const auto& q = transform.transform.rotation;
  return {q.w, q.x, q.y, q.z};
}

void setRotation(const Eigen::Quaterniond& rotation, geometry_msgs::TransformStamped& transform) {
  const Eigen::Quaterniond q = rotation.normalized();
  transform.transform.rotation.w = q.w();
  transform.transform.rotation.x = q.x();
  transform.transform.rotation.y = q.y();
  transform.transform.rotation.z = q.z();
}

/// Rotates the cameras of the Ladybug about their centre.
void turnHead(const Eigen::Quaterniond& turn, std::vector<geometry_msgs::TransformStamped>& transforms) {
  std::vector<geometry_msgs::TransformStamped*> cameras;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (geometry_msgs::TransformStamped& transform : transforms)
    for (int i = 0; i < kHeadCameras; ++i)
      if (transform.child_frame_id == urban_nav_core::frames::ladybugCamera(i)) {
        const auto& t = transform.transform.translation;
        middle += Eigen::Vector3d(t.x, t.y, t.z) / kHeadCameras;
        cameras.push_back(&transform);
      }
  for (geometry_msgs::TransformStamped* camera : cameras) {
    auto& t = camera->transform.translation;
    const Eigen::Vector3d moved = middle + turn * (Eigen::Vector3d(t.x, t.y, t.z) - middle);
    t.x = moved.x();
    t.y = moved.y();
    t.z = moved.z();
    setRotation(turn * rotationOf(*camera), *camera);
  }
}

}  // namespace

void CalibrationErrors::apply(urban_nav_sim::TopicMessage& message) const {
  const auto lag = lags.find(lagDevice(message.topic));
  if (lag == lags.end()) return;
  std::visit(
      [&](auto& pointer) {
        pointer->header.stamp = urban_nav_ros::toRosTime(urban_nav_ros::toStampNs(pointer->header.stamp) + lag->second);
      },
      message.message);
}

void CalibrationErrors::apply(std::vector<geometry_msgs::TransformStamped>& transforms) const {
  if (const auto head = turns.find(kHead); head != turns.end()) turnHead(Eigen::Quaterniond(head->second), transforms);
  for (geometry_msgs::TransformStamped& transform : transforms) {
    const auto turn = turns.find(transform.child_frame_id);
    if (turn == turns.end()) continue;
    setRotation(rotationOf(transform) * Eigen::Quaterniond(turn->second), transform);
  }
}

std::string calibrationDevices() { return kDevices; }

CalibrationErrors parseCalibrationErrors(const std::vector<std::string>& lags,
                                         const std::vector<std::string>& misplaced,
                                         const std::vector<std::string>& frames) {
  CalibrationErrors errors;
  for (const std::string& text : lags) {
    const auto words = atColon(text);
    const auto seconds = words ? urban_nav_core::parseNumber(words->second) : std::nullopt;
    const bool is_known =
        words && (", " + std::string(kDevices) + ",").find(", " + words->first + ",") != std::string::npos;
    if (!is_known || !seconds || !(std::abs(*seconds) <= kMostLag))
      throw UserError("--lag", text, std::string("DEVICE:S, DEVICE one of ") + kDevices + ", S from -10 to 10 (s)");
    errors.lags[words->first] = std::llround(1e9 * *seconds);
  }
  std::string known = kHead;
  for (const std::string& frame : frames) known += (known.empty() ? "" : ", ") + frame;
  for (const std::string& text : misplaced) {
    const auto words = atColon(text);
    const auto angles = words ? parseAngles(words->second) : std::nullopt;
    const bool is_known =
        words && (words->first == kHead || std::find(frames.begin(), frames.end(), words->first) != frames.end());
    if (!angles || !is_known) throw UserError("--misplace", text, "FRAME:ROLL,PITCH,YAW (deg), FRAME one of " + known);
    errors.turns[words->first] = (Eigen::AngleAxisd(angles->z(), Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(angles->y(), Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(angles->x(), Eigen::Vector3d::UnitX()))
                                     .toRotationMatrix();
  }
  return errors;
}

}  // namespace urban_nav
