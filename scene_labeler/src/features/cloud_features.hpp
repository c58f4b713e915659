// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "features/cube_moments.hpp"
#include "features/cube_shape.hpp"
#include "features/ground_height.hpp"

namespace scene_labeler {

/// Shapes around a point, from the finest cubes to the coarsest.
using ShapesOfPoint = std::array<const CubeShape*, kCubeLevels>;

/// Returns the names of the features of FeatureSet::Cloud: heights, shape at the local scale, shape at fixed scales.
/// The local scale is the smallest cubes of which six around the point are occupied: a line of beams, or of a ring,
/// crosses three, so that the next line is included. The share of occupied cubes is no feature, since it is that of the
/// device.
std::vector<std::string> cloudFeatureNames();

/// Writes the features of a point. `point`: relative to the origin of the cubes. Unknown values are unchanged.
void writeCloudFeatures(const ShapesOfPoint& shapes, const ColumnHeights& heights, const Eigen::Vector3f& point,
                        float* out);

}  // namespace scene_labeler
