// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {

/// Returns the topics of a recording by role, with their frames and numbers of messages. `lidars`: those of 3D LiDARs
/// that are read, which take the place of their own.
std::vector<InputStream> describeInputs(Recording& recording, const BagTopics& topics,
                                        const std::vector<InputStream>& lidars);

/// Returns the image topics of a recording, and how to choose from them, for a message.
std::string listImageTopics(Recording& recording);

/// Returns the motion sensors that `motion_input` asks for and that have a topic. Throws DataError, which names the
/// recording, if one is asked for by its name and absent.
urban_nav_core::MotionChoice chooseMotion(const BagTopics& topics, const std::string& motion_input,
                                          const std::string& recording);

/// Returns the frame in the header with which a message begins; empty if it is damaged or longer than its bytes.
std::string readHeaderFrame(const RecordedMessage& message);

}  // namespace urban_nav_input
