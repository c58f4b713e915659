// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/topic_examination.hpp"

#include <algorithm>

namespace urban_nav_input {

namespace {

bool isChosen(const BagTopics& chosen, const std::string& topic) {
  return std::any_of(chosen.chosen.begin(), chosen.chosen.end(),
                     [&](const auto& entry) { return entry.second.name == topic; });
}

Finding unrecognised(const std::string& topic, const std::string& type, Role role) {
  Finding finding{FindingKind::Topics,
                  topic + " (" + type + ") is not used: its name indicates no role; it could be " + toString(role), ""};
  finding.options = {"--topic", std::string(toString(role)) + ":=" + topic};
  finding.remedy = finding.options[0] + " " + finding.options[1];
  return finding;
}

}  // namespace

std::vector<Finding> topicFindings(const std::map<std::string, std::string>& available, const BagTopics& chosen) {
  struct TypeOfRole {
    const char* type;
    Role role;
  };
  std::vector<Finding> findings;
  std::vector<std::string> given;
  for (const TypeOfRole& each :
       {TypeOfRole{"sensor_msgs/LaserScan", Role::LaserLeft}, TypeOfRole{"sensor_msgs/LaserScan", Role::LaserRight},
        TypeOfRole{"sensor_msgs/Imu", Role::Imu}, TypeOfRole{"sensor_msgs/NavSatFix", Role::Gps}}) {
    if (chosen.find(each.role)) continue;
    for (const auto& [topic, type] : available) {
      if (type != each.type || isChosen(chosen, topic) || std::find(given.begin(), given.end(), topic) != given.end())
        continue;
      findings.push_back(unrecognised(topic, type, each.role));
      given.push_back(topic);
      break;
    }
  }
  const auto isChosen = [&chosen](const std::string& topic) {
    return std::any_of(chosen.chosen.begin(), chosen.chosen.end(),
                       [&](const auto& entry) { return entry.second.name == topic; });
  };
  const bool has_scan = std::any_of(available.begin(), available.end(),
                                    [](const auto& entry) { return entry.second == "sensor_msgs/LaserScan"; });
  if (has_scan || chosen.find(Role::Points0)) return findings;
  for (const auto& [topic, type] : available) {
    if (!isCloudType(type)) continue;
    if (isChosen(topic)) break;  // a planar laser, which has separate findings
    findings.push_back(unrecognised(topic, type, Role::Points0));
    findings.back().remedy +=
        " for the sweeps of a 3D LiDAR; clouds of a planar laser become scans by rosrun "
        "pointcloud_to_laserscan pointcloud_to_laserscan_node";
    break;
  }
  return findings;
}

}  // namespace urban_nav_input
