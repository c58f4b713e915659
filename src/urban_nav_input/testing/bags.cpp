// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/testing/bags.hpp"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <list>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "urban_nav_core/types/frames.hpp"

namespace urban_nav_input::testing {

namespace {

void writeCompressed(const rosbag::MessageInstance& instance, rosbag::Bag& bag) {
  const auto image = instance.instantiate<sensor_msgs::Image>();
  if (!image) return;
  const cv::Mat grey(static_cast<int>(image->height), static_cast<int>(image->width), CV_8UC1, image->data.data(),
                     image->step);
  cv::Mat colour;
  cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
  sensor_msgs::CompressedImage message;
  message.header = image->header;
  message.format = "png";
  cv::imencode(".png", colour, message.data);
  const bool left = instance.getTopic().find("left") != std::string::npos;
  bag.write(left ? "/cam0/image_raw/compressed" : "/cam1/image_raw/compressed", instance.getTime(), message);
}

}  // namespace

void delayBag(const std::string& from, const std::string& to, double seconds) {
  rosbag::Bag in(from, rosbag::bagmode::Read), out(to, rosbag::bagmode::Write);
  const ros::Duration delay(seconds);
  rosbag::View view(in);
  for (const rosbag::MessageInstance& instance : view) {
    const ros::Time time = instance.getTime() + delay;
    if (const auto image = instance.instantiate<sensor_msgs::Image>()) {
      image->header.stamp += delay;
      out.write(instance.getTopic(), time, *image);
    } else if (const auto info = instance.instantiate<sensor_msgs::CameraInfo>()) {
      info->header.stamp += delay;
      out.write(instance.getTopic(), time, *info);
    } else if (instance.getTopic() == "/tf_static") {
      out.write(instance.getTopic(), time, instance);
    }
  }
}

void rewriteBag(const std::string& from, const std::string& to, Rewrite how) {
  rosbag::Bag in(from, rosbag::bagmode::Read), out(to, rosbag::bagmode::Write);
  std::mt19937 random(7);
  rosbag::View view(in);
  for (const rosbag::MessageInstance& instance : view) {
    const std::string& topic = instance.getTopic();
    switch (how) {
      case Rewrite::Shuffle: {
        const double delay = 0.04 * static_cast<double>(random()) / 4294967296.0;
        out.write(topic, instance.getTime() + ros::Duration(topic == "/tf_static" ? 0.0 : delay), instance);
        break;
      }
      case Rewrite::WithoutTruth:
        if (topic != "/ground_truth/pose") out.write(topic, instance.getTime(), instance);
        break;
      case Rewrite::CompressedColourUnderOtherNames: writeCompressed(instance, out); break;
    }
  }
}

void splitBag(const std::string& from, const std::vector<std::string>& parts) {
  constexpr double kSpeed = 0.5;  // m/s, of the drive rendered by makeKittiFolder()
  rosbag::Bag in(from, rosbag::bagmode::Read);
  std::list<rosbag::Bag> out;
  for (const std::string& part : parts) out.emplace_back(part, rosbag::bagmode::Write);
  rosbag::View view(in);
  const double span = (view.getEndTime() - view.getBeginTime()).toSec() + 0.05;
  std::mt19937 random(7);
  const auto extractPart = [&](const ros::Time& time) -> rosbag::Bag& {
    const double share = (time - view.getBeginTime()).toSec() / span;
    return *std::next(out.begin(), static_cast<int>(share * static_cast<double>(parts.size())));
  };
  for (const rosbag::MessageInstance& instance : view) {
    if (const auto transforms = instance.instantiate<tf2_msgs::TFMessage>()) {
      geometry_msgs::TransformStamped imu = transforms->transforms.front();
      imu.header.frame_id = "base_link";
      imu.child_frame_id = "imu_link";
      imu.transform = geometry_msgs::Transform();
      imu.transform.rotation.x = 0.6;
      imu.transform.rotation.w = 0.8;
      transforms->transforms.push_back(imu);
      out.front().write(instance.getTopic(), instance.getTime(), *transforms);
      continue;
    }
    const ros::Time time = instance.getTime() + ros::Duration(0.04 * static_cast<double>(random()) / 4294967296.0);
    extractPart(time).write(instance.getTopic(), time, instance);
    if (instance.getTopic() != "/stereo/left/image_raw") continue;
    sensor_msgs::Imu imu;
    imu.header.stamp = time;
    imu.header.frame_id = "imu_link";
    imu.linear_acceleration.y = 9.4;
    imu.linear_acceleration.z = 2.8;
    imu.angular_velocity.z = 0.1;
    extractPart(time).write("/imu/data", time, imu);
    nav_msgs::Odometry wheels;
    wheels.header.stamp = time;
    wheels.pose.pose.position.x =
        kSpeed * (time - view.getBeginTime()).toSec() + 1e-3 * static_cast<double>(random() % 1000) / 1000.0;
    wheels.pose.pose.orientation.w = 1.0;
    extractPart(time).write("/wheel_odom", time, wheels);
    for (int camera = 0; camera < 5; ++camera) {
      sensor_msgs::Image image;
      image.header.stamp = instance.instantiate<sensor_msgs::Image>()->header.stamp;
      image.header.frame_id = urban_nav_core::frames::ladybugCamera(camera);
      image.encoding = "mono8";
      image.width = image.step = 4;
      image.height = 1;
      image.data.assign(4, static_cast<std::uint8_t>(camera));
      const ros::Time received = time + ros::Duration(0.003 * (5 - camera));
      extractPart(std::min(received, view.getEndTime()))
          .write("/ladybug/camera" + std::to_string(camera) + "/image_raw", received, image);
    }
  }
}

}  // namespace urban_nav_input::testing
