// SPDX-License-Identifier: BSD-3-Clause
#include "recording/camera_topics.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "recording/role_names.hpp"

namespace urban_nav_input {

namespace {

using TopicTypes = std::map<std::string, std::string>;

/// Returns the part of a topic's name before "depth" or "aligned_depth".
std::string depthNamespace(const std::string& topic) {
  return topic.substr(0, std::min(topic.find("depth"), topic.find("aligned_depth")));
}

/// Returns the namespace of a camera: the name without its last part, and without the transport.
std::string cameraNamespace(std::string topic) {
  const std::size_t transport = topic.rfind("/compressed");
  if (transport != std::string::npos) topic.resize(transport);
  const std::size_t last = topic.rfind('/');
  return last == std::string::npos ? std::string() : topic.substr(0, last);
}

bool isNamedAfterColour(const std::string& topic) {
  return contains(topic, "color") || contains(topic, "colour") || contains(topic, "rgb");
}

/// Returns whether a name is that of images computed from others, or of images without colour.
bool isWithoutColour(const std::string& topic) {
  static constexpr std::array<const char*, 22> kWords = {
      "depth",  "disparity", "theora",  "debug",   "mask",    "label",      "segment", "semantic",
      "detect", "overlay",   "infra",   "/ir/",    "thermal", "confidence", "grey",    "gray",
      "mono",   "tracks",    "matches", "annotat", "heatmap", "feature"};
  return std::any_of(kWords.begin(), kWords.end(), [&](const char* word) { return contains(topic, word); });
}

}  // namespace

bool isTaken(const BagTopics& topics, const std::string& topic) {
  return std::any_of(topics.chosen.begin(), topics.chosen.end(),
                     [&](const auto& chosen) { return chosen.second.name == topic; });
}

void guessInfo(const TopicTypes& available, Role image, Role info, BagTopics& topics) {
  if (topics.find(info) || !topics.find(image)) return;
  std::string folder = topics.find(image)->name;
  while (folder.find('/') != std::string::npos) {
    folder.resize(folder.rfind('/'));
    const auto found = available.find(folder + "/camera_info");
    if (found != available.end() && fits(info, found->second)) {
      topics.chosen[info] = {found->first, found->second};
      return;
    }
  }
}

void guessDepth(const TopicTypes& available, BagTopics& topics) {
  constexpr int kAligned = 2, kCompressed = 1;              // penalties
  std::map<std::string, std::pair<int, ChosenTopic>> best;  // by namespace
  for (const auto& [topic, type] : available) {
    if (!isImageType(type) || !contains(topic, "depth") || isTaken(topics, topic) || contains(topic, "theora") ||
        contains(topic, "disparity"))
      continue;
    const bool is_compressed = type == "sensor_msgs/CompressedImage";
    if (is_compressed && !contains(topic, "compressedDepth")) continue;  // pictures of depths, by JPEG
    const int penalty = (contains(topic, "aligned") ? kAligned : 0) + (is_compressed ? kCompressed : 0);
    const auto found = best.emplace(depthNamespace(topic), std::make_pair(penalty, ChosenTopic{topic, type}));
    if (penalty < found.first->second.first) found.first->second = {penalty, {topic, type}};
  }
  std::size_t camera = 0;
  for (auto& [name, chosen] : best) {
    while (camera < kDepthCameras && topics.find(depthRole(camera))) ++camera;
    if (camera == kDepthCameras) break;
    topics.chosen[depthRole(camera)] = std::move(chosen.second);
  }
  for (camera = 0; camera < kDepthCameras; ++camera)
    guessInfo(available, depthRole(camera), depthInfoRole(camera), topics);
}

void guessColour(const TopicTypes& available, BagTopics& topics) {
  constexpr int kPlain = 4, kRectified = 2, kRaw = 1;       // penalties; a raw image takes the longest to read
  std::map<std::string, std::pair<int, ChosenTopic>> best;  // by namespace
  const std::optional<ChosenTopic> left = topics.find(Role::Left), right = topics.find(Role::Right);
  for (const auto& [topic, type] : available) {
    if (!isImageType(type) || isTaken(topics, topic) || isWithoutColour(topic)) continue;
    const std::string camera = cameraNamespace(topic);
    if (right && camera == cameraNamespace(right->name) && left && camera != cameraNamespace(left->name)) continue;
    const bool is_of_left = left && camera == cameraNamespace(left->name);
    if ((is_of_left && !isNamedAfterColour(topic)) || available.count(camera + "/camera_info") == 0) continue;
    const int penalty = (isNamedAfterColour(topic) ? 0 : kPlain) + (isRectifiedName(topic) ? kRectified : 0) +
                        (type == "sensor_msgs/Image" ? kRaw : 0);
    const auto found = best.emplace(camera, std::make_pair(penalty, ChosenTopic{topic, type}));
    if (penalty < found.first->second.first) found.first->second = {penalty, {topic, type}};
  }
  std::vector<std::pair<int, ChosenTopic>> cameras;
  for (auto& [name, chosen] : best) cameras.push_back(std::move(chosen));
  std::stable_sort(cameras.begin(), cameras.end(),
                   [](const auto& a, const auto& b) { return (a.first < kPlain) > (b.first < kPlain); });
  std::size_t number = 0;
  for (auto& [penalty, topic] : cameras) {
    while (number < kColourCameras && topics.find(colourRole(number))) ++number;
    if (number == kColourCameras) break;
    topics.chosen[colourRole(number)] = std::move(topic);
  }
  for (number = 0; number < kColourCameras; ++number)
    guessInfo(available, colourRole(number), colourInfoRole(number), topics);
}

}  // namespace urban_nav_input
