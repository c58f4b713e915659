// SPDX-License-Identifier: BSD-3-Clause
#include "recording/bag_contents.hpp"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_input {

using urban_nav_core::Pose;

namespace {

constexpr std::size_t kTfSamples = 1000;
constexpr double kSamePlace = 1e-3;                // m
constexpr double kSameAngle = 0.1 * M_PI / 180.0;  // rad

/// The first transform of a link of /tf, and whether it changed later.
struct TfLink {
  geometry_msgs::TransformStamped first;
  Pose T_parent_child;
  bool moves = false;
};

bool isSamePlace(const Pose& a, const Pose& b) {
  return (a.t() - b.t()).norm() < kSamePlace && a.q().angularDistance(b.q()) < kSameAngle;
}

std::map<std::string, TfLink> readLinks(Recording& recording) {
  std::map<std::string, TfLink> links;  // by child
  for (RecordingFile* file : recording.files()) {
    MessageSelection selection({file}, std::vector<std::string>{urban_nav_ros::topics::kTransforms, "tf"}, {});
    const std::size_t step = std::max<std::size_t>(1, selection.size() / kTfSamples);
    std::size_t i = 0;
    while (const std::optional<RecordedMessage> instance = selection.next()) {
      // All of the first ones, then some drawn by a hash (Knuth), since a stride could select a single publisher.
      const std::uint32_t draw = static_cast<std::uint32_t>(i) * 2654435761U;
      if (i++ > kTfSamples / 10 && (draw >> 8U) % step != 0) continue;
      const auto message = instance->as<tf2_msgs::TFMessage>();
      if (!message) continue;
      for (const geometry_msgs::TransformStamped& transform : message->transforms) {
        const std::optional<Pose> pose = urban_nav_ros::toPose(transform.transform);
        if (!pose) continue;
        const auto [link, is_new] = links.try_emplace(transform.child_frame_id, TfLink{transform, *pose, false});
        if (is_new) continue;
        const bool is_same = link->second.first.header.frame_id == transform.header.frame_id &&
                             isSamePlace(link->second.T_parent_child, *pose);
        link->second.moves = link->second.moves || !is_same;
      }
    }
  }
  return links;
}

}  // namespace

urban_nav_ros::StaticTransforms readTransforms(Recording& recording) {
  urban_nav_ros::StaticTransforms transforms;
  RecordedMessages messages = recording.messages({urban_nav_ros::topics::kStaticTransforms, "tf_static"});
  while (const std::optional<RecordedMessage> each = messages.next())
    if (const auto message = each->as<tf2_msgs::TFMessage>()) transforms.add(*message);
  for (const auto& [child, link] : readLinks(recording)) {
    if (transforms.hasParent(child)) continue;
    if (link.moves) transforms.addMoving(link.first.header.frame_id, child);
    else transforms.add(link.first);
  }
  return transforms;
}

}  // namespace urban_nav_input
