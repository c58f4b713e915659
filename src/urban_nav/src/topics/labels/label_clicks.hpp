// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/training/teaching.hpp"
#include "topics/labels/drive_bag.hpp"

namespace urban_nav {

/// Classes assigned by hand to superpixels of bags, each by one of its returns.
class LabelClicks {
 public:
  /// Reads `bag,side,stamp_ns,beam,class[,trajectory]`: `bag` and `trajectory` are paths, from the folder of the file
  /// unless absolute; `side` is left or right; `stamp_ns,beam` name a return as laser_SIDE_labels.csv does. Throws
  /// UserError naming the line of a side or class that does not exist, and of a bag with two trajectories.
  explicit LabelClicks(const std::string& path);

  std::size_t size() const { return count_; }
  /// Adds the superpixels of the clicked returns in each frame to a fold. Returns the number of returns added. Throws
  /// UserError if a bag has no such return.
  std::size_t addTo(const scene_labeler::LabelModel& model, const DriveOptions& options, Console& console,
                    scene_labeler::TrainingFold& fold) const;

 private:
  struct Click {
    urban_nav_core::StampNs scan = 0;
    std::uint16_t beam = 0;
    scene_labeler::SceneClass label = scene_labeler::SceneClass::None;
    std::string where;  // line of the file
  };
  struct ClickedBag {
    std::string bag, trajectory;
    std::array<std::vector<Click>, kBothSides.size()> clicks;
  };
  class Collector;
  ClickedBag& bagOf(const std::string& bag, const std::string& trajectory, const std::string& where);

  std::vector<ClickedBag> bags_;
  std::size_t count_ = 0;
};

}  // namespace urban_nav
