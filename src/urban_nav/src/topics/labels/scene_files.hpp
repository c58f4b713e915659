// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene_labeler/model/label_model.hpp"
#include "scene_labeler/scene.hpp"

namespace urban_nav {

/// Files of one scene (docs/files.md, Labels).
struct SceneFiles {
  std::string name;        ///< of the scene: file name without _points and extension
  std::string points;      ///< path of the returns
  std::string image;       ///< path; empty without one
  std::string projection;  ///< path of projection.txt beside the image
};

/// Finds the scenes of folders and files, in the order of their names; scenes of different folders may have the same
/// name. Throws UserError for a path without scenes, an image without projection.txt, and a duplicate scene.
std::vector<SceneFiles> findScenes(const std::vector<std::string>& sources);

/// Returns the name of the scene of a file of returns: its name without _points and extension.
std::string sceneName(const std::string& path);

/// Returns a unique name for each scene: its name, or its path if two scenes have the same name.
std::vector<std::string> uniqueSceneNames(const std::vector<SceneFiles>& scenes);

/// A scene as read.
struct SceneInput {
  scene_labeler::Scene scene;
  /// m, whole: a point of the file is `offset` + a point of the scene. 0 along axes whose coordinates are within 1 km.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  bool is_of_side_lasers = false;  ///< map of urban_nav with points of the robot's side lasers
};

/// Returns the model for a scene: that of the side lasers for a map of them, otherwise that of its device.
const scene_labeler::LabelModel& chooseModel(const SceneInput& input, const scene_labeler::LabelModel& model);

/// Reads the returns and the image of a scene; no labels. Throws UserError for a file of another format, DataError for
/// an image that cannot be decoded.
SceneInput readScene(const SceneFiles& files);

/// Reads the column `label` of the returns, otherwise `scalar_label` (CloudCompare), `semantic` (KITTI-360), or
/// `classification` (LAS). Throws UserError without any of them, for a non-integer value, and for a classification
/// without a class map, since its codes are not numbers of classes.
std::vector<std::int64_t> readSceneLabels(const SceneFiles& files, bool has_class_map);

}  // namespace urban_nav
