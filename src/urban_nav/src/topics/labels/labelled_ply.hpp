// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/labelling/map_labeler.hpp"

namespace urban_nav {

/// Adds uchar label, float label_probability and uchar unsure to each vertex of the map.ply at `path`. Throws DataError
/// if the file is not a map or the numbers of vertices and labels differ.
void addLabelsToPly(const std::string& path, const std::vector<scene_labeler::PointLabel>& labels);

}  // namespace urban_nav
