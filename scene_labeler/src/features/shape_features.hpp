// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/features/feature_table.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Returns the names of the cloud features, reflectance last.
std::vector<std::string> shapeFeatureNames();

/// Writes the cloud features into columns `first`, `first` + 1, ... of a table with a row per return.
void measureShape(const Scene& scene, bool with_reflectance, std::size_t first, FeatureTable& table);

/// Writes the features of FeatureSet::Cloud (cloud_features.hpp) into a table with a row per return.
void measureCloudShape(const Scene& scene, FeatureTable& table);

/// Returns the unit normal of the surface around each point, of either sign; zero without a surface.
std::vector<Eigen::Vector3f> measureNormals(const std::vector<Eigen::Vector3f>& points);

/// Returns the names of the paper's cloud features: height above ground, vertical component of the normal, planarity.
std::vector<std::string> paperShapeNames();
void measurePaperShape(const Scene& scene, std::size_t first, FeatureTable& table);

}  // namespace scene_labeler
