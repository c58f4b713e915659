// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/console.hpp"
#include "base/json.hpp"
#include "urban_nav_input/session/open.hpp"

namespace urban_nav {

/// Output of a conversion.
struct Converted {
  std::map<std::string, std::int64_t> counts;  ///< messages by topic
  std::vector<std::string> notes;              ///< assumptions and omissions, for the user
  std::vector<std::string> files = {};         ///< files of a conversion into several; empty: one
};

/// Converts a folder of KITTI or EuRoC to a bag: rectified images with camera_info, static tf, sweeps of the LiDAR, IMU
/// and truth if present. `ahead`: decodes images in a second thread, without effect on the bag. Throws DataError naming
/// the file for a missing or damaged image or sweep; then writes no bag.
Converted convertStereoFolder(const std::string& folder, const std::string& bag,
                              urban_nav_input::SourceOptions options, Console& console, bool ahead = true);

/// Converts a folder of the New College data set (or only its .alog) to a bag: lasers with reflectance, odometry in
/// REP-103 axes, stereo and panoramic images if present. Throws UserError naming file and line for damaged parts; then
/// writes no bag.
Converted convertNewCollege(const std::string& source, const std::string& bag, Console& console);

}  // namespace urban_nav
