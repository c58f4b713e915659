// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pose_graph/level.hpp"

namespace pose_graph {

/// Returns Level::R_map_first for an upward unit vector.
Eigen::Matrix3d levelAxes(const Eigen::Vector3d& up);
/// Returns the square root of the largest eigenvalue.
double largestSigma(const Eigen::Matrix3d& covariance);
/// Returns a Level of unknown direction with this reason.
Level unknownLevel(LevelTrouble trouble, const std::string& sentence);

}  // namespace pose_graph
