// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Files of the New College data set in a folder, at a depth of at most three. Its parts are downloaded separately, so
/// each may be absent.
struct NewCollegeFiles {
  struct Image {
    urban_nav_core::StampNs stamp = 0;
    std::string path;
    int camera = 0;  ///< ladybug: 0...4
  };
  struct Pair {
    urban_nav_core::StampNs stamp = 0;
    std::string left, right;  ///< either may be empty
  };
  std::string alog;             ///< empty: none
  std::vector<Image> panorama;  ///< ladybug_TIME-K.jpg, in order of time and camera
  std::vector<Pair> stereo;     ///< StereoImage__TIME-left.pnm and its partner, in order of time
};

/// Finds the files. `source`: a folder, or an .alog file in the folder to search. Throws UserError without files, or
/// for more than one log.
NewCollegeFiles findNewCollege(const std::string& source);

/// Returns the last number before "-left" or "-right" (or "-K") of a file name as a time:
/// "StereoImage__1225719884.662058-left.pnm". nullopt without one.
std::optional<urban_nav_core::StampNs> stampOfName(const std::string& name);

}  // namespace urban_nav_input
