// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/pyramid.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"
#include "urban_nav_registration/stereo/descriptor.hpp"

namespace urban_nav_registration {

/// A point of a keyframe in its left optical frame.
struct ViewPoint {
  Eigen::Vector2d pixel;  ///< px of level 0
  Eigen::Vector3d ray;    ///< z = 1
  Eigen::Vector3d plane;  ///< its surface: plane . X = 1 (1/m)
  double disparity = 0.0, sigma_disparity = 1.0;
  int level = 0;

  double size() const { return 1 << level; }  ///< px of level 0 per pixel of its level
};

/// A keyframe prepared for matching: decoded image, and descriptors.
struct View {
  explicit View(const Keyframe& keyframe, const urban_nav_core::StereoCamera& camera);

  bool isReadable() const { return pyramid.levels() > 0; }

  urban_nav_core::PoseRef at;
  urban_nav_core::Pyramid pyramid;
  std::vector<ViewPoint> points;
  Descriptors descriptors;  ///< one column per point
};

}  // namespace urban_nav_registration
