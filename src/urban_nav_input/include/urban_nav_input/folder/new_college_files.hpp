// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// What lies in a folder of the New College data set, at any depth up to three; the parts were downloaded one by one,
/// so each may be absent.
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

/// `source`: a folder, or an .alog file whose folder is looked through. UserError where there is none of it, or more
/// than one log.
NewCollegeFiles findNewCollege(const std::string& source);

/// The last number before "-left" or "-right" (or "-K") of a file name, as a time:
/// "StereoImage__1225719884.662058-left.pnm". Empty if there is none.
std::optional<urban_nav_core::StampNs> stampOfName(const std::string& name);

}  // namespace urban_nav_input
