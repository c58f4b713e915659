// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Layout of a KITTI folder: `image_0` and `image_1` (odometry), `image_00` and `image_01` (raw), each with or
/// without `data/` inside, or `data_rect/` (KITTI-360); `image_2`, `image_3` (colour) if there are no others.
struct KittiLayout {
  std::string folder;
  std::string left, right;  ///< folders of images
  urban_nav_core::KittiPair pair = urban_nav_core::KittiPair::Grey;
};
std::optional<KittiLayout> findKittiLayout(const std::string& folder);

/// Returns the files of a folder of images by frame number (the digits of the file name).
std::map<std::int64_t, std::string> listFrames(const std::string& folder);

/// Reads the rectified pair from calib.txt, or calib_cam_to_cam.txt in the folder or above it, or perspective.txt in
/// the folder or in ../../calibration (KITTI-360); `width` x `height`: of the images. Throws UserError naming file and
/// line for a missing or invalid row.
urban_nav_core::StereoCamera readKittiCamera(const KittiLayout& layout, int width, int height);

/// Returns the calibration file of a folder, as for readKittiCamera(); empty without one.
std::string findKittiCalibration(const std::string& folder);

/// Returns the position of camera 0 (m) in the frame of the rectified left camera of a pair; zero without a row of it.
urban_nav_core::Vector3d readKittiOffset(const std::string& folder, urban_nav_core::KittiPair pair);

/// Stamps of frames 0, 1 ... from times.txt (s) or timestamps.txt of KITTI raw (date and time); empty without either.
struct KittiTimes {
  std::string path;
  std::vector<urban_nav_core::StampNs> stamps;
};
KittiTimes readKittiTimes(const KittiLayout& layout);

/// Throws UserError if a folder has far fewer files than numbers, which indicates another naming scheme.
void requireNumberedFrames(const std::string& folder, std::pair<std::int64_t, std::int64_t> numbers, std::size_t count);

/// Returns a stamp for each of the numbers from the first to the last: from times.txt by number (by place where the
/// counts agree only so), or at `rate` Hz (0: KITTI's 10 Hz) from zero without such a file. Appends what was assumed to
/// `notes`. Throws UserError where stamps and numbers do not belong together; `what` has the numbers: "images".
std::vector<urban_nav_core::StampNs> stampKittiFrames(const KittiLayout& layout, const std::string& what,
                                                      std::pair<std::int64_t, std::int64_t> numbers, double rate,
                                                      std::vector<std::string>& notes);

/// The frames of a folder: all numbers that either camera has, and a stamp for each (stampKittiFrames()). Throws
/// UserError where stamps and images do not belong together.
struct KittiFrames {
  std::map<std::int64_t, std::string> left, right;  ///< number to file
  std::vector<std::int64_t> numbers;
  std::vector<urban_nav_core::StampNs> stamps;
  std::vector<std::string> notes;  ///< what was assumed
};
KittiFrames listKittiFrames(const KittiLayout& layout, double rate);

/// "2011-09-26 13:02:25.964389445" as ns since 1970 (UTC); empty if it is no such text.
std::optional<urban_nav_core::StampNs> parseDateTime(const std::string& text);

}  // namespace urban_nav_input
