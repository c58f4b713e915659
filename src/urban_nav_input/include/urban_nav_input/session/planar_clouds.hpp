// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <boost/shared_ptr.hpp>
#include <map>
#include <string>
#include <vector>

#include "urban_nav_core/laser/cloud/planar_cloud.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/cloud_messages.hpp"

namespace urban_nav_input {

/// Reads the clouds of planar lasers whose drivers publish clouds instead of scans as scans. Not thread-safe.
class PlanarClouds {
 public:
  PlanarClouds() = default;
  /// Finds planar lasers among the topics of 3D LiDARs, and assigns each a free laser role, laser_right preferably to a
  /// topic whose name contains "right". Topics in `wishes` keep their roles. Remaining 3D LiDARs keep their order.
  PlanarClouds(Recording& recording, const ReceiptRange& part, const std::vector<std::string>& wishes,
               BagTopics& topics);

  bool has(const std::string& topic) const { return patterns_.count(topic) > 0; }
  /// Returns the first message of a laser, a scan or a cloud that is read as one; null without one.
  boost::shared_ptr<sensor_msgs::LaserScan> first(Recording& recording, const std::string& topic);
  /// Returns the scan in a message of a laser; null without one.
  boost::shared_ptr<sensor_msgs::LaserScan> read(const RecordedMessage& message);
  const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::map<std::string, urban_nav_core::PlanarPattern> patterns_;  // keyed by topic
  std::vector<Finding> findings_;
  CloudMessages messages_;
};

}  // namespace urban_nav_input
