// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/prior.hpp"
#include "window/state.hpp"

namespace swf_vo::gauge {

/// The six unobservable directions: a common shift and turn of everything. Derivative of a block by a small (shift,
/// turn) of the world about the point `origin`, all in the axes of `odom`. With J of any sensor or process term at the
/// same values, J G = 0 exactly, for all values (sensor_model.hpp).
urban_nav_core::Matrix6d ofPose(const urban_nav_core::Pose& T_odom_camera, const Eigen::Vector3d& origin);
Eigen::Matrix<double, 3, 6> ofLandmark(const Anchor& anchor, const Eigen::Vector3d& theta,
                                       const Eigen::Vector3d& origin);

/// Gauge directions of all blocks of the prior, at its centres: n x 6, column-major.
void ofPrior(const State& state, const Prior& prior, const Eigen::Vector3d& origin, std::vector<double>& directions);

/// Transforms (shift, turn) about `from` to (shift, turn) about `to`.
urban_nav_core::Matrix6d transport(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace swf_vo::gauge
