// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "fabmap_node/recognition/second_look.hpp"
#include "urban_nav_core/image/pyramid.hpp"

namespace fabmap_node {

/// Computes the descriptor of keyframes for the window of side `window_px` centred at `centre`, both in px of level 0.
/// Returns false if the window has too little contrast.
bool describeAsBytes(const urban_nav_core::Pyramid& pyramid, const Eigen::Vector2d& centre, double window_px,
                     ByteDescriptor& descriptor);

/// Returns the columns of `a` and `b` that are mutual nearest neighbours with a clear margin to the second nearest on
/// both sides. Requires unit vectors.
std::vector<std::pair<std::size_t, std::size_t>> mutualMatches(const LookDescriptors& a, const LookDescriptors& b);

}  // namespace fabmap_node
