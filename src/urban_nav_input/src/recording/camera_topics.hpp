// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "urban_nav_input/recording/bag_topics.hpp"

namespace urban_nav_input {

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Returns whether a topic has a role.
bool isTaken(const BagTopics& topics, const std::string& topic);

/// Finds camera_info in the namespace of the images, or one level above (.../image_raw/compressed). `available`: name
/// and type of every topic.
void guessInfo(const std::map<std::string, std::string>& available, Role image, Role info, BagTopics& topics);

/// Assigns one topic of depth images of each namespace that has any, and their camera_info, to the roles not given by
/// the user.
void guessDepth(const std::map<std::string, std::string>& available, BagTopics& topics);

/// Assigns one topic of images of each further namespace that has a camera_info to the roles of cameras that colour
/// the map: those named after colours first. Whether their pixels have colour is found when they are read.
void guessColour(const std::map<std::string, std::string>& available, BagTopics& topics);

}  // namespace urban_nav_input
