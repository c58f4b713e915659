// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

/// Frame and size of the first image of a camera; empty and 0 without images.
struct FirstImage {
  std::string frame;
  int width = 0, height = 0;
};
FirstImage findFirstImage(Recording& recording, const ChosenTopic& topic);

/// Returns the note on a left camera of unknown extrinsics.
std::string describeAssumedPlace(const std::string& camera_frame);

/// The camera_info of a stereo pair.
struct CameraInfos {
  urban_nav_core::CameraInfo left, right;
  std::string frame;  ///< of the left one
};
/// Throws UserError if one is missing, DataError if the recording `name` is too damaged to read it.
CameraInfos readCameraInfos(Recording& recording, const BagTopics& topics, const std::string& name);

}  // namespace urban_nav_input
