// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"

namespace urban_nav_input {

/// Returns a finding for each topic suitable for a role without a topic: lasers, IMU and GPS by their types, with the
/// option that selects it; and for point clouds if there are neither scans nor 3D LiDARs. `available`: name and type of
/// every topic.
std::vector<Finding> topicFindings(const std::map<std::string, std::string>& available, const BagTopics& chosen);

}  // namespace urban_nav_input
