// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// Topics of a recording that are used, apart from those with a role.
struct UsedTopics {
  std::vector<std::string> read;       ///< by the reader
  std::vector<std::string> elsewhere;  ///< read by stages
  std::vector<std::string> lidars;     ///< of 3D LiDARs that are used
  urban_nav_core::MotionChoice motion;
  bool has_imu_place;  ///< the axes of the IMU in base_link are known
};

/// Returns a sentence on the topics that are not used; empty if all are.
std::string describeUnused(Recording& recording, const BagTopics& topics, const PlanarClouds& planar_clouds,
                           const UsedTopics& used);

/// Returns the motion sensors of `motion_input` that have a topic. Throws DataError naming the recording if an
/// explicitly requested one is absent.
urban_nav_core::MotionChoice chooseMotion(const BagTopics& topics, const std::string& motion_input,
                                          const std::string& recording);

/// Returns the frame in the header of a message; empty if the header is damaged or truncated.
std::string readHeaderFrame(const RecordedMessage& message);

}  // namespace urban_nav_input
