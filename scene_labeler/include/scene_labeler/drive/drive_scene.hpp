// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scene_labeler/scene.hpp"
#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace scene_labeler {

/// Return of a side laser along the path of the robot.
struct DriveReturn {
  urban_nav_core::StampNs scan = 0;                    ///< stamp of its scan
  std::uint16_t beam = 0;                              ///< index in the scan
  float reflectance = 0.0F;                            ///< in units of the device
  double travelled = 0.0;                              ///< m along the path, at its scan
  Eigen::Vector3f point = Eigen::Vector3f::Zero();     ///< m, in the world, rendered at its own time
  Eigen::Vector3f to_laser = Eigen::Vector3f::Zero();  ///< m, from the point to the laser at that time
};

/// Image of a side camera.
struct SideView {
  urban_nav_core::RawCamera camera;
  urban_nav_core::Pose T_world_camera;  ///< of the optical frame, at the time of the image
  cv::Mat image;                        ///< CV_8UC3, blue, green, red
  cv::Mat classes = {};                 ///< CV_8U, SceneClass of each pixel by another source; empty: unavailable
};

/// Scene of returns subsampled to the first one in each cube of 5 cm.
struct DriveScene {
  Scene scene;                                       ///< its points are relative to `origin`
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< m, in the world
  std::vector<std::uint32_t> first_of_point;         ///< index of the return of each point of the scene
  std::vector<std::uint32_t> point_of_return;        ///< for each return
};

/// Sets the image of a scene, projects its points plus `origin` into it through the lens, and determines the visible
/// points.
void projectView(const SideView& view, const Eigen::Vector3f& origin, Scene& scene);

/// Subsamples returns and projects them into an image, through the lens. An empty image gives a scene without one.
DriveScene makeDriveScene(const std::vector<DriveReturn>& returns, const SideView& view);

}  // namespace scene_labeler
