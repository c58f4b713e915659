// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/sensors/pairing_examination.hpp"
#include "urban_nav_ros/stereo_calibration.hpp"

namespace urban_nav_input {

/// Topics of the images of a stereo camera in a recording, and the convention for pairing their stamps.
struct StereoTopics {
  std::string left, right;
  PairingConvention pairing = {};
};

/// camera_info of both cameras, and their source.
struct StereoInfos {
  urban_nav_core::CameraInfo left, right;
  std::string where;
};

/// Returns the calibration of the images of a recording. Determines from the images whether they are rectified, or by
/// `named_as_rectified` if that is not clear. Appends a note if the name is misleading. Throws the UserError of
/// StereoCalibration.
urban_nav_ros::StereoCalibration makeCalibration(Recording& recording, const StereoTopics& topics,
                                                 const ReceiptRange& part, bool named_as_rectified,
                                                 const StereoInfos& infos, std::vector<std::string>& notes);

/// Adds a note if a camera has coefficients of distortion without the name of their model.
void noteDistortionModel(const urban_nav_core::CameraInfo& info, std::vector<std::string>& notes);

}  // namespace urban_nav_input
