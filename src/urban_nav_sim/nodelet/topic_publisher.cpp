// SPDX-License-Identifier: BSD-3-Clause
#include "topic_publisher.hpp"

#include <rosgraph_msgs/Clock.h>
#include <tf2_msgs/TFMessage.h>

#include <utility>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_sim {

using urban_nav_core::StampNs;

namespace {

constexpr StampNs kClockStep = 5'000'000;  // ns, as the truth

tf2_msgs::TFMessage asTransform(const geometry_msgs::PoseStamped& pose) {
  geometry_msgs::TransformStamped transform;
  transform.header = pose.header;
  transform.child_frame_id = urban_nav_core::frames::kBaseLink;
  transform.transform.translation.x = pose.pose.position.x;
  transform.transform.translation.y = pose.pose.position.y;
  transform.transform.translation.z = pose.pose.position.z;
  transform.transform.rotation = pose.pose.orientation;
  tf2_msgs::TFMessage message;
  message.transforms.push_back(std::move(transform));
  return message;
}

}  // namespace

TopicPublisher::TopicPublisher(ros::NodeHandle& nh, const std::set<Sensor>& sensors, std::uint32_t queue)
    : static_(nh.advertise<tf2_msgs::TFMessage>(urban_nav_ros::topics::kStaticTransforms, 10, true)),
      truth_(nh.advertise<tf2_msgs::TFMessage>(urban_nav_ros::topics::kTruthTransforms, queue)) {
  for (const TopicMessage& each : listTopics(sensors)) {
    publishers_[each.topic] = std::visit(
        [&](const auto& message) {
          using Message = typename std::decay_t<decltype(message)>::element_type;
          return nh.advertise<Message>(each.topic, queue);
        },
        each.message);
  }
  if (ros::Time::isSimTime()) clock_ = nh.advertise<rosgraph_msgs::Clock>(urban_nav_ros::topics::kClock, queue);
}

void TopicPublisher::publish(const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  static_.publish(message);
}

void TopicPublisher::publish(const TopicMessage& message) {
  const ros::Publisher& publisher = publishers_.at(message.topic);
  std::visit([&](const auto& pointer) { publisher.publish(pointer); }, message.message);
  if (const auto* truth = std::get_if<geometry_msgs::PoseStampedPtr>(&message.message))
    truth_.publish(asTransform(**truth));
}

void TopicPublisher::advance(StampNs now) {
  if (now_ && now >= *now_ && now - *now_ < kClockStep) return;
  now_ = now;
  repeatClock();
}

void TopicPublisher::repeatClock() {
  if (!clock_ || !now_) return;
  rosgraph_msgs::Clock message;
  message.clock = urban_nav_ros::toRosTime(*now_);
  clock_.publish(message);
}

}  // namespace urban_nav_sim
