// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/RelativePose.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "heard_topics.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "views.hpp"

namespace loop_metric {

/// What the nodelets of this package subscribe: each message is told to `topics` and handed to whoever takes it, in the callback's thread. In a pause
/// all but odometry is dropped and counted, so that odometry has no gap behind it.
class Subscriptions {
 public:
  /// `queue`: of each subscription, messages. `topics` must outlive it.
  Subscriptions(ros::NodeHandle nh, int queue, HeardTopics& topics)
      : nh_(std::move(nh)), queue_(static_cast<std::uint32_t>(queue)), topics_(topics) {}

  template <typename Message, typename Take>
  void listen(const std::string& name, HeardTopics::Kind kind, const Take& take) {
    const std::string topic = nh_.resolveName(name);
    topics_.expect(topic, kind);
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this, topic, kind, take](const boost::shared_ptr<const Message>& message) {
          topics_.received(topic);
          if (paused_ && kind != HeardTopics::Kind::Odometry) ++paused_dropped_;
          else take(message);
        };
    subscribers_.push_back(nh_.subscribe<Message>(name, queue_, callback));
  }

  /// /tf_static, both poses of the odometry, and, where `stereo` is wanted, the images and calibration of both sides: to taker.put(). What is no
  /// pose is left out and counted as damaged.
  template <typename Taker>
  void listenToRobot(bool stereo, bool compressed, Taker& taker);

  void pause(bool paused) { paused_ = paused; }
  void countDamaged() { ++damaged_; }
  std::int64_t pausedDropped() const { return paused_dropped_; }
  std::int64_t damaged() const { return damaged_; }
  /// Nobody calls any more.
  void end() { subscribers_.clear(); }

 private:
  template <typename Message, typename Taker>
  void listenToImages(const std::string& name, urban_nav_ros::Side side, Taker& taker) {
    listen<Message>(name, HeardTopics::Kind::Images, [&taker, side](const boost::shared_ptr<const Message>& message) {
      taker.put(ImageInput{side, message, urban_nav_ros::toStampNs(message->header.stamp)});
    });
  }

  ros::NodeHandle nh_;
  const std::uint32_t queue_;
  HeardTopics& topics_;
  std::vector<ros::Subscriber> subscribers_;
  std::atomic<bool> paused_{false};
  std::atomic<std::int64_t> paused_dropped_{0}, damaged_{0};
};

template <typename Taker>
void Subscriptions::listenToRobot(bool stereo, bool compressed, Taker& taker) {
  using Kind = HeardTopics::Kind;
  using urban_nav_ros::Side;
  subscribers_.push_back(nh_.subscribe<tf2_msgs::TFMessage>(
      "/tf_static", 100, [&taker](const tf2_msgs::TFMessageConstPtr& message) { taker.put(message); }));
  for (const auto& [side, name] : {std::pair(Side::Left, "left"), std::pair(Side::Right, "right")}) {
    if (!stereo) break;
    const std::string images = std::string("stereo/") + name + "/image_raw";
    listen<sensor_msgs::CameraInfo>(std::string("stereo/") + name + "/camera_info", Kind::Images,
                                    [&taker, side = side](const sensor_msgs::CameraInfoConstPtr& message) {
                                      taker.put(InfoInput{side, message});
                                    });
    if (compressed) listenToImages<sensor_msgs::CompressedImage>(images, side, taker);
    else listenToImages<sensor_msgs::Image>(images, side, taker);
  }
  listen<nav_msgs::Odometry>("vo/odometry", Kind::Odometry, [this, &taker](const nav_msgs::OdometryConstPtr& message) {
    if (const auto T_odom_base = urban_nav_ros::toPose(message->pose.pose))
      taker.put(urban_nav_core::StampedPose{urban_nav_ros::toStampNs(message->header.stamp), *T_odom_base});
    else countDamaged();
  });
  listen<urban_nav_msgs::RelativePose>("vo/relative_pose", Kind::Odometry,
                                       [this, &taker](const urban_nav_msgs::RelativePoseConstPtr& message) {
                                         if (const auto step = urban_nav_ros::toRelativePose(*message))
                                           taker.put(*step);
                                         else countDamaged();
                                       });
}

}  // namespace loop_metric
