// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <list>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "input/clock_steps.hpp"
#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_ros/stereo_calibration.hpp"

namespace urban_nav {

/// Left and right image of a pair, grey.
using ImagePair = std::pair<cv::Mat, cv::Mat>;

/// Topics of the images of a stereo camera in a recording.
struct StereoTopics {
  std::string left, right;
  urban_nav_core::StampNs right_delay = 0;  ///< ns by which right images are stamped later than the left ones
};

/// Returns about `count` decoded pairs of a recording, evenly distributed; fewer where partners are not found by their
/// stamps.
std::vector<ImagePair> samplePairs(std::list<rosbag::Bag>& bags, const StereoTopics& topics, const ReceiptRange& part,
                                   int count);

/// How well the rows of matching points agree if images are taken as rectified already, and if they are rectified by
/// their calibration.
struct RectificationChoice {
  bool is_decided = false;                          ///< one interpretation is clearly better
  bool is_rectified = false;                        ///< the images are rectified already
  double as_they_are_px = 0.0, rectified_px = 0.0;  ///< median row error of each interpretation
};

/// Judges pairs under both interpretations. `rectifying`: rectifies images by their calibration. Not decided with fewer
/// than three pairs, few matches, or rows that agree about equally well. Deterministic.
RectificationChoice chooseRectification(const std::vector<ImagePair>& pairs,
                                        const urban_nav_ros::StereoCalibration& rectifying);

/// camera_info of both cameras, and where they come from.
struct StereoInfos {
  urban_nav_core::CameraInfo left, right;
  std::string where;
};

/// Returns the calibration of the images of a recording. Whether they are rectified already is judged by what they
/// show; `named_as_rectified` decides where that is not clear. Appends a note where the name misleads. Throws
/// UserError, as StereoCalibration.
urban_nav_ros::StereoCalibration makeCalibration(std::list<rosbag::Bag>& bags, const StereoTopics& topics,
                                                 const ReceiptRange& part, bool named_as_rectified,
                                                 const StereoInfos& infos, std::vector<std::string>& notes);

}  // namespace urban_nav
