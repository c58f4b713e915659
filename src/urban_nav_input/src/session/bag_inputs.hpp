// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/planar_clouds.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {

/// Returns the topics of a recording by role, with their frames and numbers of messages. `lidars`: replace the entries
/// of 3D LiDARs that are read.
std::vector<InputStream> describeInputs(Recording& recording, const BagTopics& topics,
                                        const std::vector<InputStream>& lidars);

/// Returns the fault of a recording without a stereo pair, with its image topics and the options to choose them.
/// `clouds`: findings on planar lasers that publish clouds.
std::string describeNoImages(Recording& recording, const BagTopics& topics, const std::vector<Finding>& clouds);

/// Returns the topics of the stereo images. Requires both.
std::vector<std::string> imageTopics(const BagTopics& topics);

/// Adds the chosen topics that are read to `used`: all but clouds that are neither of a planar laser nor among
/// `lidars`.
void addUsedTopics(const BagTopics& topics, const PlanarClouds& planar_clouds, const std::vector<std::string>& lidars,
                   std::set<std::string>& used);

/// Returns the motion sensors of `motion_input` that have a topic. Throws DataError naming the recording if an
/// explicitly requested one is absent.
urban_nav_core::MotionChoice chooseMotion(const BagTopics& topics, const std::string& motion_input,
                                          const std::string& recording);

/// Returns the frame in the header of a message; empty if the header is damaged or truncated.
std::string readHeaderFrame(const RecordedMessage& message);

}  // namespace urban_nav_input
