// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "recording/bag_order.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_ros/stereo_feed.hpp"

namespace urban_nav_input {

/// Returns sentences on images and motion inputs dropped because of their stamps.
std::vector<std::string> droppedMessages(const urban_nav_ros::StereoFeed& feed, const BagTopics& topics);

/// Returns notes for the user on the order and the stamps of a recording.
std::vector<std::string> describeOrder(const StampSurvey& survey, bool is_sorted);

}  // namespace urban_nav_input
