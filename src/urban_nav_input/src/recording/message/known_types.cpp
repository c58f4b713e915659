// SPDX-License-Identifier: BSD-3-Clause
#include "recording/message/known_types.hpp"

#include <geometry_msgs/Accel.h>
#include <geometry_msgs/AccelStamped.h>
#include <geometry_msgs/AccelWithCovariance.h>
#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <geometry_msgs/Inertia.h>
#include <geometry_msgs/InertiaStamped.h>
#include <geometry_msgs/Point.h>
#include <geometry_msgs/Point32.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Polygon.h>
#include <geometry_msgs/PolygonStamped.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Pose2D.h>
#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovariance.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <geometry_msgs/Wrench.h>
#include <geometry_msgs/WrenchStamped.h>
#include <nav_msgs/GetMapFeedback.h>
#include <nav_msgs/GetMapGoal.h>
#include <nav_msgs/GetMapResult.h>
#include <nav_msgs/GridCells.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/ChannelFloat32.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Illuminance.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/JoyFeedback.h>
#include <sensor_msgs/JoyFeedbackArray.h>
#include <sensor_msgs/LaserEcho.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/MultiDOFJointState.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/NavSatStatus.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/PointField.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/RegionOfInterest.h>
#include <sensor_msgs/RelativeHumidity.h>
#include <sensor_msgs/Temperature.h>
#include <sensor_msgs/TimeReference.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Byte.h>
#include <std_msgs/ByteMultiArray.h>
#include <std_msgs/Char.h>
#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Duration.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/Header.h>
#include <std_msgs/Int16.h>
#include <std_msgs/Int16MultiArray.h>
#include <std_msgs/Int32.h>
#include <std_msgs/Int32MultiArray.h>
#include <std_msgs/Int64.h>
#include <std_msgs/Int64MultiArray.h>
#include <std_msgs/Int8.h>
#include <std_msgs/Int8MultiArray.h>
#include <std_msgs/MultiArrayDimension.h>
#include <std_msgs/MultiArrayLayout.h>
#include <std_msgs/String.h>
#include <std_msgs/Time.h>
#include <std_msgs/UInt16.h>
#include <std_msgs/UInt16MultiArray.h>
#include <std_msgs/UInt32.h>
#include <std_msgs/UInt32MultiArray.h>
#include <std_msgs/UInt64.h>
#include <std_msgs/UInt64MultiArray.h>
#include <std_msgs/UInt8.h>
#include <std_msgs/UInt8MultiArray.h>
#include <tf2_msgs/TF2Error.h>
#include <tf2_msgs/TFMessage.h>

#include <map>

namespace urban_nav_input {

namespace {

template <typename... Messages>
std::map<std::string, KnownType> listTypes() {
  namespace traits = ros::message_traits;
  return {{traits::DataType<Messages>::value(),
           {traits::MD5Sum<Messages>::value(), traits::Definition<Messages>::value()}}...};
}

}  // namespace

std::optional<KnownType> findKnownType(const std::string& type) {
  static const std::map<std::string, KnownType> types = listTypes<
      geometry_msgs::Accel, geometry_msgs::AccelStamped, geometry_msgs::AccelWithCovariance,
      geometry_msgs::AccelWithCovarianceStamped, geometry_msgs::Inertia, geometry_msgs::InertiaStamped,
      geometry_msgs::Point, geometry_msgs::Point32, geometry_msgs::PointStamped, geometry_msgs::Polygon,
      geometry_msgs::PolygonStamped, geometry_msgs::Pose, geometry_msgs::Pose2D, geometry_msgs::PoseArray,
      geometry_msgs::PoseStamped, geometry_msgs::PoseWithCovariance, geometry_msgs::PoseWithCovarianceStamped,
      geometry_msgs::Quaternion, geometry_msgs::QuaternionStamped, geometry_msgs::Transform,
      geometry_msgs::TransformStamped, geometry_msgs::Twist, geometry_msgs::TwistStamped,
      geometry_msgs::TwistWithCovariance, geometry_msgs::TwistWithCovarianceStamped, geometry_msgs::Vector3,
      geometry_msgs::Vector3Stamped, geometry_msgs::Wrench, geometry_msgs::WrenchStamped, nav_msgs::GetMapFeedback,
      nav_msgs::GetMapGoal, nav_msgs::GetMapResult, nav_msgs::GridCells, nav_msgs::MapMetaData, nav_msgs::OccupancyGrid,
      nav_msgs::Odometry, nav_msgs::Path, sensor_msgs::BatteryState, sensor_msgs::CameraInfo,
      sensor_msgs::ChannelFloat32, sensor_msgs::CompressedImage, sensor_msgs::FluidPressure, sensor_msgs::Illuminance,
      sensor_msgs::Image, sensor_msgs::Imu, sensor_msgs::JointState, sensor_msgs::Joy, sensor_msgs::JoyFeedback,
      sensor_msgs::JoyFeedbackArray, sensor_msgs::LaserEcho, sensor_msgs::LaserScan, sensor_msgs::MagneticField,
      sensor_msgs::MultiDOFJointState, sensor_msgs::MultiEchoLaserScan, sensor_msgs::NavSatFix,
      sensor_msgs::NavSatStatus, sensor_msgs::PointCloud, sensor_msgs::PointCloud2, sensor_msgs::PointField,
      sensor_msgs::Range, sensor_msgs::RegionOfInterest, sensor_msgs::RelativeHumidity, sensor_msgs::Temperature,
      sensor_msgs::TimeReference, std_msgs::Bool, std_msgs::Byte, std_msgs::ByteMultiArray, std_msgs::Char,
      std_msgs::ColorRGBA, std_msgs::Duration, std_msgs::Empty, std_msgs::Float32, std_msgs::Float32MultiArray,
      std_msgs::Float64, std_msgs::Float64MultiArray, std_msgs::Header, std_msgs::Int16, std_msgs::Int16MultiArray,
      std_msgs::Int32, std_msgs::Int32MultiArray, std_msgs::Int64, std_msgs::Int64MultiArray, std_msgs::Int8,
      std_msgs::Int8MultiArray, std_msgs::MultiArrayDimension, std_msgs::MultiArrayLayout, std_msgs::String,
      std_msgs::Time, std_msgs::UInt16, std_msgs::UInt16MultiArray, std_msgs::UInt32, std_msgs::UInt32MultiArray,
      std_msgs::UInt64, std_msgs::UInt64MultiArray, std_msgs::UInt8, std_msgs::UInt8MultiArray, tf2_msgs::TF2Error,
      tf2_msgs::TFMessage>();
  const auto found = types.find(type);
  return found == types.end() ? std::nullopt : std::optional<KnownType>(found->second);
}

}  // namespace urban_nav_input
