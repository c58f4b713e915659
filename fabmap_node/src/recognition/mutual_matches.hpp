// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fabmap_node/recognition/second_look.hpp"

namespace fabmap_node {

/// Returns the sum over all elements of the difference of their levels, 0 ... 128.
int levelDistance(const LookFeature& a, const LookFeature& b);

/// Returns the displacements in image shares, b less a, of the features of `a` and `b` that are each other's nearest,
/// clearly nearer than the second nearest on both sides, among those whose heights differ by at most `height_band`.
/// Requires heights in ascending order.
std::vector<Eigen::Vector2f> mutualMatches(const LookFeatures& a, const LookFeatures& b, float height_band);

}  // namespace fabmap_node
