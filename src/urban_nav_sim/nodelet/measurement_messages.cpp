// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/ros/measurement_messages.hpp"

#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/point_cloud.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_sim {

namespace frames = urban_nav_core::frames;
namespace robot_topics = urban_nav_ros::topics;

using urban_nav_core::StampNs;

namespace {

constexpr int kJpegQuality = 90;   // about the quality of the compression of the Ladybug2
constexpr double kUnknown = -1.0;  // first element of the covariance of an unmeasured quantity (sensor_msgs/Imu)

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

template <typename Message>
TopicMessage onTopic(const std::string& topic, Message message) {
  return {topic, boost::make_shared<Message>(std::move(message))};
}

const char* imageTopic(Side side) { return side == Side::Left ? robot_topics::kLeftImage : robot_topics::kRightImage; }
const char* infoTopic(Side side) { return side == Side::Left ? robot_topics::kLeftInfo : robot_topics::kRightInfo; }
const char* scanTopic(Side side) { return side == Side::Left ? robot_topics::kLaserLeft : robot_topics::kLaserRight; }
std::string panoramaTopic(int camera) {
  return std::string(robot_topics::kPanoramaImages.at(static_cast<std::size_t>(camera))) + "/compressed";
}
const char* panoramaInfoTopic(int camera) { return robot_topics::kPanoramaInfos.at(static_cast<std::size_t>(camera)); }

void addImage(Side side, const cv::Mat& pixels, sensor_msgs::CameraInfo camera, StampNs stamp,
              std::vector<TopicMessage>& messages) {
  if (pixels.empty()) return;
  sensor_msgs::Image image = urban_nav_ros::toImageMessage(pixels);
  image.header = camera.header = header(stamp, side == Side::Left ? frames::kStereoLeft : frames::kStereoRight);
  messages.push_back(onTopic(imageTopic(side), std::move(image)));
  messages.push_back(onTopic(infoTopic(side), std::move(camera)));
}

template <typename Message>
void addTopic(const std::string& topic, std::vector<TopicMessage>& topics) {
  topics.push_back(onTopic(topic, Message()));
}

void addTopics(Sensor sensor, std::vector<TopicMessage>& topics) {
  switch (sensor) {
    case Sensor::Stereo:
      for (const Side side : {Side::Left, Side::Right}) {
        addTopic<sensor_msgs::Image>(imageTopic(side), topics);
        addTopic<sensor_msgs::CameraInfo>(infoTopic(side), topics);
      }
      return;
    case Sensor::Ladybug:
      for (int camera = 0; camera < 5; ++camera) {
        addTopic<sensor_msgs::CompressedImage>(panoramaTopic(camera), topics);
        addTopic<sensor_msgs::CameraInfo>(panoramaInfoTopic(camera), topics);
      }
      return;
    case Sensor::Lasers:
      for (const Side side : {Side::Left, Side::Right}) addTopic<sensor_msgs::LaserScan>(scanTopic(side), topics);
      return;
    case Sensor::Imu:
      addTopic<sensor_msgs::Imu>(robot_topics::kImu, topics);
      addTopic<sensor_msgs::MagneticField>(robot_topics::kMagneticField, topics);
      return;
    case Sensor::Wheels: addTopic<nav_msgs::Odometry>(robot_topics::kWheelOdometry, topics); return;
    case Sensor::Gps:
      addTopic<sensor_msgs::NavSatFix>(robot_topics::kGpsFix, topics);
      addTopic<geometry_msgs::TwistStamped>(robot_topics::kGpsVelocity, topics);
      return;
    case Sensor::Lidar3d: addTopic<sensor_msgs::PointCloud2>(robot_topics::kPoints, topics); return;
  }
}

}  // namespace

std::vector<TopicMessage> listTopics(const std::set<Sensor>& sensors) {
  std::vector<TopicMessage> topics;
  for (const Sensor sensor : sensors) addTopics(sensor, topics);
  addTopic<geometry_msgs::PoseStamped>(robot_topics::kTruthPose, topics);
  return topics;
}

std::vector<geometry_msgs::TransformStamped> staticTransforms(const Session& session) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const auto& [frame, T_base_sensor] : session.places()) {
    transforms.push_back(urban_nav_ros::toStaticTransform(frames::kBaseLink, frame, T_base_sensor));
    transforms.back().header.stamp = urban_nav_ros::toRosTime(session.begin());
  }
  return transforms;
}

MeasurementMessages::MeasurementMessages(const Session& session)
    : left_(urban_nav_ros::toCameraInfoMessage(session.stereoInfo(Side::Left))),
      right_(urban_nav_ros::toCameraInfoMessage(session.stereoInfo(Side::Right))) {
  for (int i = 0; i < 5; ++i)
    ladybug_[static_cast<std::size_t>(i)] = urban_nav_ros::toCameraInfoMessage(session.ladybugInfo(i));
}

std::vector<TopicMessage> MeasurementMessages::convert(const Measurement& measurement) {
  return std::visit([this](const auto& any) { return from(any); }, measurement);
}

std::vector<TopicMessage> MeasurementMessages::from(const StereoMeasurement& pair) const {
  Messages messages;
  addImage(Side::Left, pair.left, left_, pair.stamp, messages);
  addImage(Side::Right, pair.right, right_, pair.stamp, messages);
  return messages;
}

std::vector<TopicMessage> MeasurementMessages::from(const LadybugMeasurement& panorama) const {
  sensor_msgs::CameraInfo info = ladybug_[static_cast<std::size_t>(panorama.camera)];
  sensor_msgs::CompressedImage image;
  image.header = info.header = header(panorama.stamp, frames::ladybugCamera(panorama.camera));
  image.format = "jpeg";
  cv::imencode(".jpg", panorama.image, image.data, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return {onTopic(panoramaTopic(panorama.camera), std::move(image)),
          onTopic(panoramaInfoTopic(panorama.camera), std::move(info))};
}

std::vector<TopicMessage> MeasurementMessages::from(const LaserMeasurement& turn) {
  sensor_msgs::LaserScan scan =
      urban_nav_ros::toLaserScanMessage(turn.scan, turn.side == Side::Left ? frames::kLaserLeft : frames::kLaserRight);
  scan.header.seq = turns_[static_cast<std::size_t>(turn.side)]++;
  return {onTopic(scanTopic(turn.side), std::move(scan))};
}

std::vector<TopicMessage> MeasurementMessages::from(const ImuMeasurement& imu) const {
  sensor_msgs::Imu motion;
  motion.header = header(imu.stamp, frames::kImu);
  motion.orientation.w = 1.0;
  motion.orientation_covariance[0] = kUnknown;
  set(imu.rate, motion.angular_velocity);
  set(imu.specific_force, motion.linear_acceleration);
  sensor_msgs::MagneticField field;
  field.header = motion.header;
  set(imu.field, field.magnetic_field);
  return {onTopic(robot_topics::kImu, std::move(motion)), onTopic(robot_topics::kMagneticField, std::move(field))};
}

std::vector<TopicMessage> MeasurementMessages::from(const WheelMeasurement& wheels) const {
  nav_msgs::Odometry odometry;
  odometry.header = header(wheels.stamp, frames::kOdom);
  odometry.child_frame_id = frames::kBaseLink;
  odometry.pose.pose = urban_nav_ros::toPoseMessage(wheels.T_odom_base);
  odometry.twist.twist.linear.x = wheels.speed;
  odometry.twist.twist.angular.z = wheels.yaw_rate;
  return {onTopic(robot_topics::kWheelOdometry, std::move(odometry))};
}

std::vector<TopicMessage> MeasurementMessages::from(const GpsMeasurement& gps) const {
  sensor_msgs::NavSatFix fix;
  fix.header = header(gps.stamp, frames::kGps);
  fix.status.status = gps.has_fix ? sensor_msgs::NavSatStatus::STATUS_FIX : sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  fix.status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
  fix.latitude = gps.latitude;
  fix.longitude = gps.longitude;
  fix.altitude = gps.altitude;
  for (std::size_t k = 0; k < 3; ++k)
    fix.position_covariance[4 * k] = gps.sigma[static_cast<Eigen::Index>(k)] * gps.sigma[static_cast<Eigen::Index>(k)];
  fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  geometry_msgs::TwistStamped velocity;
  velocity.header = fix.header;
  set(gps.velocity, velocity.twist.linear);
  Messages messages = {onTopic(robot_topics::kGpsFix, std::move(fix))};
  if (gps.has_fix) messages.push_back(onTopic(robot_topics::kGpsVelocity, std::move(velocity)));
  return messages;
}

std::vector<TopicMessage> MeasurementMessages::from(const LidarMeasurement& lidar) const {
  sensor_msgs::PointCloud2 points = urban_nav_ros::toSweepMessage(lidar.sweep, lidar.stamp);
  points.header.frame_id = frames::kLidar3d;
  return {onTopic(robot_topics::kPoints, std::move(points))};
}

std::vector<TopicMessage> MeasurementMessages::from(const TruthMeasurement& truth) const {
  geometry_msgs::PoseStamped pose;
  pose.header = header(truth.stamp, "ground_truth");
  pose.pose = urban_nav_ros::toPoseMessage(truth.T_world_base);
  return {onTopic(robot_topics::kTruthPose, std::move(pose))};
}

}  // namespace urban_nav_sim
