// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/measurement_topics.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>

#include <opencv2/imgcodecs.hpp>

#include "convert/laser_topics.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_sim::Side;

namespace {

constexpr int jpeg_quality = 90;  // the Ladybug2's own compression is about as good
constexpr double unknown = -1.0;  // first element of a covariance: what it belongs to is not measured (sensor_msgs/Imu)

std_msgs::Header header(StampNs stamp, const std::string& frame) {
  std_msgs::Header made;
  made.stamp = urban_nav_ros::toRosTime(stamp);
  made.frame_id = frame;
  return made;
}

void set(const Eigen::Vector3d& from, geometry_msgs::Vector3& to) {
  to.x = from.x();
  to.y = from.y();
  to.z = from.z();
}

void writeImage(const std::string& side, const cv::Mat& pixels, sensor_msgs::CameraInfo camera, StampNs stamp,
                BagWriter& bag) {
  if (pixels.empty()) return;
  sensor_msgs::Image image = urban_nav_ros::toImageMessage(pixels);
  image.header = camera.header = header(stamp, "stereo_" + side + "_optical_frame");
  bag.write("/stereo/" + side + "/image_raw", stamp, image);
  bag.write("/stereo/" + side + "/camera_info", stamp, camera);
}

}  // namespace

MeasurementTopics::MeasurementTopics(const urban_nav_sim::Session& session, BagWriter& bag)
    : bag_(bag),
      left_(urban_nav_ros::toCameraInfoMessage(session.stereoInfo(Side::Left))),
      right_(urban_nav_ros::toCameraInfoMessage(session.stereoInfo(Side::Right))) {
  for (int i = 0; i < 5; ++i)
    ladybug_[static_cast<std::size_t>(i)] = urban_nav_ros::toCameraInfoMessage(session.ladybugInfo(i));
  std::vector<geometry_msgs::TransformStamped> places;
  for (const auto& [frame, T_base_sensor] : session.places())
    places.push_back(urban_nav_ros::toStaticTransform("base_link", frame, T_base_sensor));
  bag_.writeStaticTransforms(session.begin(), places);
}

void MeasurementTopics::write(const urban_nav_sim::Measurement& measurement) {
  std::visit([this](const auto& any) { put(any); }, measurement);
}

void MeasurementTopics::put(const urban_nav_sim::StereoMeasurement& pair) {
  writeImage("left", pair.left, left_, pair.stamp, bag_);
  writeImage("right", pair.right, right_, pair.stamp, bag_);
}

void MeasurementTopics::put(const urban_nav_sim::LadybugMeasurement& panorama) {
  const std::string name = "camera" + std::to_string(panorama.camera);
  sensor_msgs::CameraInfo& info = ladybug_[static_cast<std::size_t>(panorama.camera)];
  sensor_msgs::CompressedImage message;
  message.header = info.header = header(panorama.stamp, "ladybug_" + name + "_optical_frame");
  message.format = "jpeg";
  cv::imencode(".jpg", panorama.image, message.data, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
  bag_.write("/ladybug/" + name + "/image_raw/compressed", panorama.stamp, message);
  bag_.write("/ladybug/" + name + "/camera_info", panorama.stamp, info);
}

void MeasurementTopics::put(const urban_nav_sim::LaserMeasurement& turn) {
  writeLaser(turn.side == Side::Left ? "left" : "right", turn.scan, turns_[static_cast<std::size_t>(turn.side)]++,
             bag_);
}

void MeasurementTopics::put(const urban_nav_sim::ImuMeasurement& imu) {
  sensor_msgs::Imu message;
  message.header = header(imu.stamp, "imu_link");
  message.orientation.w = 1.0;
  message.orientation_covariance[0] = unknown;
  set(imu.rate, message.angular_velocity);
  set(imu.specific_force, message.linear_acceleration);
  bag_.write("/imu/data", imu.stamp, message);
  sensor_msgs::MagneticField field;
  field.header = message.header;
  set(imu.field, field.magnetic_field);
  bag_.write("/imu/mag", imu.stamp, field);
}

void MeasurementTopics::put(const urban_nav_sim::WheelMeasurement& wheels) {
  nav_msgs::Odometry message;
  message.header = header(wheels.stamp, "odom");
  message.child_frame_id = "base_link";
  message.pose.pose = urban_nav_ros::toPoseMessage(wheels.T_odom_base);
  message.twist.twist.linear.x = wheels.speed;
  message.twist.twist.angular.z = wheels.yaw_rate;
  bag_.write("/wheel_odom", wheels.stamp, message);
}

void MeasurementTopics::put(const urban_nav_sim::GpsMeasurement& gps) {
  sensor_msgs::NavSatFix fix;
  fix.header = header(gps.stamp, "gps_link");
  fix.status.status = gps.has_fix ? sensor_msgs::NavSatStatus::STATUS_FIX : sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  fix.status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
  fix.latitude = gps.latitude;
  fix.longitude = gps.longitude;
  fix.altitude = gps.altitude;
  for (std::size_t k = 0; k < 3; ++k)
    fix.position_covariance[4 * k] = gps.sigma[static_cast<Eigen::Index>(k)] * gps.sigma[static_cast<Eigen::Index>(k)];
  fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  bag_.write("/gps/fix", gps.stamp, fix);
  if (!gps.has_fix) return;
  geometry_msgs::TwistStamped velocity;
  velocity.header = fix.header;
  set(gps.velocity, velocity.twist.linear);
  bag_.write("/gps/vel", gps.stamp, velocity);
}

void MeasurementTopics::put(const urban_nav_sim::TruthMeasurement& truth) {
  geometry_msgs::PoseStamped message;
  message.header = header(truth.stamp, "ground_truth");
  message.pose = urban_nav_ros::toPoseMessage(truth.T_world_base);
  bag_.write("/ground_truth/pose", truth.stamp, message);
}

}  // namespace urban_nav
