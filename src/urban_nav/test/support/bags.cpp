// SPDX-License-Identifier: BSD-3-Clause
#include "support/bags.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace urban_nav::testing {

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

}  // namespace urban_nav::testing
