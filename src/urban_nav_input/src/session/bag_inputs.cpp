// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_inputs.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "recording/unused_topics.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace {

/// Returns the image topics of a recording with the options to choose them.
std::string listImageTopics(Recording& recording) {
  std::string text;
  for (const auto& [topic, type] : recording.topicTypes())
    if (isImageType(type)) text += (text.empty() ? "" : ", ") + topic;
  return text.empty() ? "it has no images" : text + " (--topic left:=NAME --topic right:=NAME)";
}

}  // namespace

std::string describeNoImages(Recording& recording, const BagTopics& topics, const std::vector<Finding>& clouds) {
  const std::optional<ChosenTopic> depth = topics.find(Role::Depth0);
  return "has no stereo pair of image topics: " + listImageTopics(recording) +
         (depth ? "; " + depth->name +
                      " is that of a depth camera, which adds surfaces to the map of a robot whose "
                      "motion is measured by a stereo camera or a LiDAR"
                : "") +
         (clouds.empty() ? "" : "; " + clouds.front().text + ", and have no 3D pose");
}

std::vector<std::string> imageTopics(const BagTopics& topics) {
  return {topics.find(Role::Left)->name, topics.find(Role::Right)->name};
}

std::string describeUnused(Recording& recording, const BagTopics& topics, const PlanarClouds& planar_clouds,
                           const UsedTopics& used) {
  std::set<std::string> names(used.read.begin(), used.read.end());
  names.insert(used.elsewhere.begin(), used.elsewhere.end());
  for (const auto& [role, topic] : topics.chosen)
    if (!isCloudType(topic.type) || planar_clouds.has(topic.name) ||
        std::count(used.lidars.begin(), used.lidars.end(), topic.name) > 0)
      names.insert(topic.name);
  const auto leave = [&](Role role, bool is_of_use) {  // examined in any case
    if (const auto topic = topics.find(role); topic && !is_of_use) names.erase(topic->name);
  };
  leave(Role::Wheels, used.motion.wheels);
  leave(Role::Imu, used.has_imu_place || used.motion.gyroscope);
  return describeUnusedTopics(recording, names);
}

urban_nav_core::MotionChoice chooseMotion(const BagTopics& topics, const std::string& motion_input,
                                          const std::string& recording) {
  urban_nav_core::MotionChoice motion = urban_nav_core::toMotionChoice(motion_input);
  motion.gyroscope = motion.gyroscope && topics.find(Role::Imu);
  motion.wheels = motion.wheels && topics.find(Role::Wheels);
  if (motion.is_required && !motion.any())
    throw urban_nav_core::DataError(recording, "has no topic for input.motion_input = " + motion_input, "");
  return motion;
}

std::string readHeaderFrame(const RecordedMessage& message) {
  constexpr std::size_t kLengthAt = 12, kTextAt = 16;  // after seq (ROS 1) or the encapsulation (CDR), and the stamp
  const ByteView bytes = message.bytes();
  if (bytes.data == nullptr || bytes.size < kTextAt) return {};
  const bool is_big_endian = message.connection().encoding == "cdr" && bytes.data[1] == 0;
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length |= static_cast<std::size_t>(bytes.data[kLengthAt + i]) << 8U * (is_big_endian ? 3 - i : i);
  if (length > bytes.size - kTextAt) return {};
  std::string frame(bytes.data + kTextAt, bytes.data + kTextAt + length);
  while (!frame.empty() && frame.back() == '\0') frame.pop_back();
  return frame;
}

std::vector<InputStream> describeInputs(Recording& recording, const BagTopics& topics,
                                        const std::vector<InputStream>& lidars) {
  std::vector<InputStream> inputs;
  for (const auto& [role, topic] : topics.chosen) {
    const std::string word = toString(role);
    const auto lidar =
        std::find_if(lidars.begin(), lidars.end(), [&](const InputStream& each) { return each.role == word; });
    if (lidar != lidars.end()) {
      inputs.push_back(*lidar);
      continue;
    }
    InputStream stream;
    stream.role = word;
    stream.topic = topic.name;
    stream.messages = static_cast<std::int64_t>(recording.count(topic.name));
    RecordedMessages messages = recording.messages({topic.name});
    if (const std::optional<RecordedMessage> first = messages.next()) stream.frame = readHeaderFrame(*first);
    inputs.push_back(std::move(stream));
  }
  return inputs;
}

}  // namespace urban_nav_input
