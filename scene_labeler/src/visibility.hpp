// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "scene_labeler/scene.hpp"
#include "urban_nav_core/camera/pinhole.hpp"

namespace scene_labeler {

/// Camera of an image with its pose: p_cam = R p + t.
struct ViewCamera {
  urban_nav_core::Pinhole pinhole;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// Sets SceneView::is_visible of a scene whose returns are projected.
void findVisible(const ViewCamera& camera, Scene& scene);

}  // namespace scene_labeler
