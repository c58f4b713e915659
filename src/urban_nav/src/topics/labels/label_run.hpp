// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/console.hpp"
#include "base/json.hpp"
#include "scene_labeler/labelling/labeler.hpp"
#include "topics/labels/scene_files.hpp"

namespace urban_nav {

/// Statistics of labelling scenes.
struct LabelRun {
  std::size_t frames = 0, points = 0, labelled = 0, unsure = 0;
  std::size_t new_place_frames = 0;  ///< frames of kinds of places without training data
  double seconds = 0.0;              ///< of labelling, without files
  std::vector<double> milliseconds;  ///< of each scene
  bool has_look = false;             ///< whether any scene has an image

  /// `frames`, `points`, `ms_per_frame_median`, `us_per_point`, `modalities`, `unsure_share`,
  /// `new_place_frames`, `precision`, `sure_probability` (null for a model without thresholds).
  Json toJson(const scene_labeler::LabelModel& model) const;
};

/// Called with the number of a scene, the scene, and its labels, which it may change.
using TakeSceneLabels =
    std::function<void(std::size_t index, const SceneInput& input, scene_labeler::SceneLabels& labels)>;

/// Labels scenes one after another and adds the statistics to `run`.
void labelScenes(const scene_labeler::LabelModel& model, const std::vector<SceneFiles>& scenes, int superpixel,
                 Console& console, const TakeSceneLabels& take, LabelRun& run);

/// Returns a share or probability with six decimals, without the digits that a float does not have.
double toRoundDouble(float value);

/// Returns the names of the columns of probabilities: ",p_grass,p_paved".
std::string printClassColumns(const std::vector<scene_labeler::SceneClass>& classes);
/// Appends ",label,probability,p_...,unsure" of a return and ends the line.
void appendLabelCells(const scene_labeler::SceneLabels& labels, std::size_t i, std::string& text);

/// Returns NAME_labels.csv: `index,label,probability,p_CLASS...,unsure`, one row per return.
std::string printSceneLabels(const scene_labeler::SceneLabels& labels);

}  // namespace urban_nav
