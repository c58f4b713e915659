// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/console.hpp"
#include "base/json.hpp"
#include "urban_nav_input/session/open.hpp"

namespace urban_nav {

/// What a conversion wrote.
struct Converted {
  std::map<std::string, std::int64_t> counts;  ///< messages by topic
  std::vector<std::string> notes;              ///< what was assumed or left out
  std::vector<std::string> files = {};         ///< files of a conversion into several; empty: one
};

/// A folder of KITTI or EuRoC into a bag: rectified images with camera_info, static tf, IMU and truth where the folder
/// has them. `ahead`: pictures are decoded by a second thread, the bag is the same. Throws DataError naming the file
/// for an image that is missing or damaged: no bag is left.
Converted convertStereoFolder(const std::string& folder, const std::string& bag,
                              const urban_nav_input::SourceOptions& options, Console& console, bool ahead = true);

/// A folder of the New College data set (or its .alog alone) into a bag: lasers with reflectance, odometry in REP-103,
/// whatever stereo and panoramic images there are. Throws UserError naming file and line for damaged parts: no bag is
/// left.
Converted convertNewCollege(const std::string& source, const std::string& bag, Console& console);

}  // namespace urban_nav
