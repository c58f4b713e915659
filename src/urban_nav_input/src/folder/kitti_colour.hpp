// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_input/folder/kitti_layout.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {

/// The colour images of a KITTI folder: `image_2` or `image_02` next to a grey pair, or the left images of a colour
/// pair.
class KittiColour {
 public:
  /// Finds `image_2` or `image_02` next to a grey pair. `T_base_camera`: of its left camera. Without a row of its
  /// calibration, or if the images are grey, a note gives the reason and nullopt is returned.
  static std::optional<KittiColour> ofCamera2(const KittiLayout& layout, const urban_nav_core::Pose& T_base_camera,
                                              std::vector<std::string>& notes);
  /// Uses the left images of a colour pair; nullopt if they are grey.
  static std::optional<KittiColour> ofPair(const KittiLayout& layout, const std::map<std::int64_t, std::string>& files,
                                           const urban_nav_core::RawCamera& camera,
                                           const urban_nav_core::Pose& T_base_camera);

  const ColourCamera& camera() const { return camera_; }
  const std::string& folder() const { return folder_; }
  std::size_t files() const { return files_.size(); }
  /// Returns the image of a frame, with its stamp; nullopt without one.
  std::optional<ColourInput> read(std::int64_t number, urban_nav_core::StampNs stamp) const;

 private:
  std::string folder_;
  std::map<std::int64_t, std::string> files_;  // by number of the frame
  ColourCamera camera_;
};

}  // namespace urban_nav_input
