// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

/// Returns a unique name for each scene: its name, or its path if two scenes have the same name.
std::vector<std::string> uniqueSceneNames(const std::vector<SceneFiles>& scenes);

/// Reads the returns and the image of a scene; no labels. Coordinates beyond 1 km are moved near the origin. Throws
/// UserError for a file of another format, DataError for an image that cannot be decoded.
scene_labeler::Scene readScene(const SceneFiles& files);

/// Reads the column `label`, or `scalar_label` of CloudCompare, of the returns. Throws UserError if there is neither,
/// or for a non-integer value.
std::vector<std::int64_t> readSceneLabels(const SceneFiles& files);

}  // namespace urban_nav
