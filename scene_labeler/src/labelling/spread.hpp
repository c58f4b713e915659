// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scene_labeler/classes.hpp"

namespace scene_labeler {

/// Propagates labels from points visible in images to those that are not: the log probabilities of such a point are
/// increased by those of the mean of visible points within about 2 m, if there are any. Shape hardly distinguishes
/// kinds of ground; among these the exponent of the point's own probabilities is one half. `logs`: per point and class.
/// `is_shown`, `is_hidden`: per point; other points are neither.
void spreadToHidden(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint8_t>& is_shown,
                    const std::vector<std::uint8_t>& is_hidden, const std::vector<SceneClass>& classes,
                    std::vector<float>& logs);

/// Smooths labels: multiplies the probabilities of each labelled point by a power of the mean probabilities within
/// about 0.7 m, since surfaces are larger than superpixels. `is_labelled`: per point.
void smoothLabels(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint8_t>& is_labelled,
                  std::size_t classes, std::vector<float>& logs);

}  // namespace scene_labeler
