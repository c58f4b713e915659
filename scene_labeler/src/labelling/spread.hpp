// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scene_labeler/classes.hpp"

namespace scene_labeler {

/// Uses what images say of the surroundings for points that no image shows: the log probabilities of such a point are
/// multiplied by the mean probabilities of the shown points within some 2 m, if there are any. Which kind of ground it
/// is shape hardly tells: there the power of the point's own answer is a half. `logs`: of each point one for each
/// class. `is_shown`, `is_hidden`: of each point; others are neither.
void spreadToHidden(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint8_t>& is_shown,
                    const std::vector<std::uint8_t>& is_hidden, const std::vector<SceneClass>& classes,
                    std::vector<float>& logs);

/// Smooths labels: multiplies the probabilities of each labelled point by a power of the mean probabilities within some
/// 0.7 m, since surfaces are larger than superpixels. `is_labelled`: of each point.
void smoothLabels(const std::vector<Eigen::Vector3f>& points, const std::vector<std::uint8_t>& is_labelled,
                  std::size_t classes, std::vector<float>& logs);

}  // namespace scene_labeler
