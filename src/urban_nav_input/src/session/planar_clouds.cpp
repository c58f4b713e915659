// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/planar_clouds.hpp"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <optional>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_ros/laser_scan.hpp"

namespace urban_nav_input {

using urban_nav_core::PlanarPattern;

namespace {

constexpr std::size_t kMostClouds = 100;  // read at most, for a laser with few returns

std::optional<PlanarPattern> findPattern(Recording& recording, const ReceiptRange& part, const std::string& topic,
                                         CloudMessages& reader) {
  urban_nav_core::PlanarCloudSurvey survey;
  RecordedMessages messages = recording.messages({topic}, part);
  for (std::size_t i = 0; i < kMostClouds && !survey.isComplete(); ++i) {
    const std::optional<RecordedMessage> message = messages.next();
    if (!message) break;
    if (const std::optional<CloudMessages::Cloud> cloud = reader.read(*message)) survey.add(cloud->view);
  }
  return survey.conclude();
}

bool isWished(const std::vector<std::string>& wishes, const std::string& topic) {
  return std::any_of(wishes.begin(), wishes.end(), [&](const std::string& wish) {
    const std::size_t at = wish.find(":=");
    return at != std::string::npos && wish.substr(at + 2) == topic;
  });
}

std::optional<Role> findFreeLaser(const std::string& topic, const BagTopics& topics) {
  const bool is_right = topic.find("right") != std::string::npos || topic.find("Right") != std::string::npos;
  const Role first = is_right ? Role::LaserRight : Role::LaserLeft;
  const Role second = is_right ? Role::LaserLeft : Role::LaserRight;
  for (const Role role : {first, second})
    if (!topics.find(role)) return role;
  return std::nullopt;
}

Finding toFinding(const std::string& topic, const PlanarPattern& pattern, const std::optional<Role>& role) {
  Finding finding{FindingKind::Lasers,
                  topic + ": PointCloud2 whose points lie in one plane, " +
                      urban_nav_core::formatNumber(pattern.angle_step * 180.0 / M_PI, 3) +
                      " deg between beams: a planar laser; ",
                  "no action needed; live stages need sensor_msgs/LaserScan (pointcloud_to_laserscan makes it)"};
  if (role) {
    finding.text += std::string("its clouds are read as scans of ") + toString(*role);
    if (pattern.time_field.empty()) finding.text += ", all beams of which have the stamp of their cloud";
    return finding;
  }
  finding.text += "it is not used, since laser_left and laser_right have topics";
  finding.remedy = "--topic laser_left:=" + topic +
                   " selects it instead of the present one after "
                   "pointcloud_to_laserscan has made scans of it";
  return finding;
}

}  // namespace

PlanarClouds::PlanarClouds(Recording& recording, const ReceiptRange& part, const std::vector<std::string>& wishes,
                           BagTopics& topics) {
  std::vector<ChosenTopic> lidars;
  bool has_changed = false;
  for (std::size_t i = 0; i < kPointsTopics; ++i) {
    const std::optional<ChosenTopic> topic = topics.find(pointsRole(i));
    if (!topic) continue;
    const auto pattern = isLivoxType(topic->type) || isWished(wishes, topic->name)
                             ? std::nullopt
                             : findPattern(recording, part, topic->name, messages_);
    if (!pattern) {
      lidars.push_back(*topic);
      continue;
    }
    has_changed = true;
    const std::optional<Role> role = findFreeLaser(topic->name, topics);
    findings_.push_back(toFinding(topic->name, *pattern, role));
    if (!role) continue;
    topics.chosen[*role] = *topic;
    patterns_[topic->name] = *pattern;
  }
  if (!has_changed) return;
  for (std::size_t i = 0; i < kPointsTopics; ++i) topics.chosen.erase(pointsRole(i));
  for (std::size_t i = 0; i < lidars.size(); ++i) topics.chosen[pointsRole(i)] = lidars[i];
  const auto of_points = [](const std::string& note) { return note.compare(0, 6, "points") == 0; };
  topics.notes.erase(std::remove_if(topics.notes.begin(), topics.notes.end(), of_points), topics.notes.end());
  for (const auto& [role, topic] : topics.chosen)
    if (patterns_.count(topic.name) > 0 || isCloudType(topic.type))
      topics.notes.push_back(std::string(toString(role)) + ": " + topic.name +
                             (isWished(wishes, topic.name) ? "" : " (guessed)"));
}

boost::shared_ptr<sensor_msgs::LaserScan> PlanarClouds::read(const RecordedMessage& message) {
  const auto pattern = patterns_.find(message.topic());
  if (pattern == patterns_.end()) return message.as<sensor_msgs::LaserScan>();
  const std::optional<CloudMessages::Cloud> cloud = messages_.read(message);
  const auto scan = cloud ? urban_nav_core::toPlanarScan(cloud->view, pattern->second) : std::nullopt;
  if (!scan) return nullptr;
  return boost::make_shared<sensor_msgs::LaserScan>(urban_nav_ros::toLaserScanMessage(*scan, cloud->frame));
}

boost::shared_ptr<sensor_msgs::LaserScan> PlanarClouds::first(Recording& recording, const std::string& topic) {
  RecordedMessages all = recording.messages({topic});
  while (const std::optional<RecordedMessage> each = all.next())
    if (auto scan = read(*each)) return scan;
  return nullptr;
}

}  // namespace urban_nav_input
