// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "fabmap_node/features/place_observation.hpp"
#include "urban_nav_core/image/pyramid.hpp"

namespace fabmap_node {

/// Describes the window of side `window_px` about `centre`, both in px of level 0, with the descriptor of keyframes.
/// Returns false if the window has too little contrast.
bool describeAsBytes(const urban_nav_core::Pyramid& pyramid, const Eigen::Vector2d& centre, double window_px,
                     ByteDescriptor& descriptor);

}  // namespace fabmap_node
