// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene_labeler/sweep/sweep_labeler.hpp"
#include "topics/labels/drive_bag.hpp"
#include "topics/labels/label_run.hpp"

namespace urban_nav {

/// Called with the returns of one sweep, in the frame of the trajectory. `role`: of the LiDAR, "points0".
using TakeSweepLabels =
    std::function<void(const std::string& role, const std::vector<urban_nav_core::LaserPoint>& returns,
                       const scene_labeler::SweepLabels& labels)>;

/// Sensors of a bag that `labels` can use.
struct LabelledSensors {
  bool has_sides = false;   ///< planar lasers on the sides
  bool has_lidars = false;  ///< 3D LiDARs
};
LabelledSensors findLabelledSensors(const std::string& bag, const std::vector<std::string>& topics);

/// Labels the sweeps of all 3D LiDARs of a bag, each in the cloud of the sweeps before it, as the nodelet does, and
/// adds the statistics to `run`. Throws DataError if no sweep can be used.
void labelSweeps(const scene_labeler::LabelModel& model, const std::string& bag, const DriveOptions& options,
                 Console& console, const TakeSweepLabels& take, LabelRun& run);

/// Returns the header and the rows of pointsN_labels.csv; cells of returns without an answer are empty.
std::string printSweepHeader(const std::vector<scene_labeler::SceneClass>& classes);
std::string printSweepLabels(const std::vector<urban_nav_core::LaserPoint>& returns,
                             const scene_labeler::SweepLabels& labels);

}  // namespace urban_nav
