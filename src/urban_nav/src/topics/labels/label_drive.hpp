// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scene_labeler/class_map.hpp"
#include "scene_labeler/training/training_data.hpp"
#include "topics/labels/drive_bag.hpp"
#include "topics/labels/label_run.hpp"

namespace urban_nav {

/// Classes of the returns of one side laser, of BAG_STEM.truth/laser_SIDE.csv.
class DriveTruth {
 public:
  /// Throws UserError if the file cannot be read, or has a label that is not in the class map.
  DriveTruth(const std::string& path, const scene_labeler::ClassMap& map);
  /// Returns the path for a bag.
  static std::string path(const std::string& bag, DriveSide side);

  /// Returns None where the file has no class.
  scene_labeler::SceneClass at(urban_nav_core::StampNs scan, std::uint16_t beam) const;

 private:
  std::map<urban_nav_core::StampNs, std::vector<scene_labeler::SceneClass>> scans_;
};

/// Called with the returns of one side, in order of time.
using TakeDriveLabels = std::function<void(DriveSide side, const std::vector<scene_labeler::DriveReturn>& returns,
                                           const scene_labeler::SceneLabels& labels)>;

/// Labels the returns of a bag and adds the statistics to `run`.
void labelDrive(const scene_labeler::LabelModel& model, const std::string& bag, const DriveOptions& options,
                Console& console, const TakeDriveLabels& take, LabelRun& run);

/// Computes the features of the returns of a bag and adds them with their truth as one fold named after the bag; a bag
/// that is the only source is divided into folds along its path.
void addDriveFold(const std::string& bag, const DriveOptions& options, const scene_labeler::ClassMap& map,
                  scene_labeler::FeatureSet features, bool is_alone, Console& console,
                  std::vector<scene_labeler::TrainingFold>& folds);

/// Returns the header and the rows of laser_SIDE_labels.csv.
std::string printDriveHeader(const std::vector<scene_labeler::SceneClass>& classes);
std::string printDriveLabels(const std::vector<scene_labeler::DriveReturn>& returns,
                             const scene_labeler::SceneLabels& labels);

}  // namespace urban_nav
