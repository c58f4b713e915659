// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "scene_labeler/classes.hpp"

namespace scene_labeler {

/// Device of the robot's side lasers, in Scene::device.
constexpr const char* kLms291Device = "lms291";

/// One image and the place of each return of a scene in it. Each return is projected at its own time, through the lens.
struct SceneView {
  cv::Mat image;                        ///< CV_8UC3, blue, green, red
  std::vector<Eigen::Vector2f> pixels;  ///< one per return, px; NaN if the image does not show it
  std::vector<float> depths;            ///< one per return, along the optical axis, m
  /// One per return, 1: the image shows it, since it lies within the image, in front of the camera, and nothing hides
  /// it.
  std::vector<std::uint8_t> is_visible;
};

/// Laser returns of one place, and at most one image of them.
struct Scene {
  std::string name;
  std::vector<Eigen::Vector3f> points;  ///< m, z up; points that are not finite get no label
  std::vector<float> reflectance;       ///< one per point, in units of its device; empty if there is none
  /// One per point, m: from it to where the sensor was that measured it. Features then use the reflectance without the
  /// influence of range and incidence. Empty: the reflectance is used as it is.
  std::vector<Eigen::Vector3f> to_sensor;
  std::string device;  ///< that measured the reflectance: "lms291"; empty: unknown
  SceneView view;      ///< empty image: shape only
  /// One per point, 1: gets a label; 0: only surrounds the others. Empty: all get one.
  std::vector<std::uint8_t> is_asked;

  bool isAsked(std::size_t i) const { return is_asked.empty() || is_asked[i] != 0; }
};

/// Projects the points of a scene into its image by a 3x4 matrix M: (u w, v w, w) = M (x, y, z, 1), and finds those
/// that the image shows.
void projectScene(const Eigen::Matrix<double, 3, 4>& projection, Scene& scene);

/// Returns whether an image shows anything: at least a tenth of its pixels are neither black nor saturated. That of a
/// covered or a dazzled camera does not.
bool isUsable(const cv::Mat& image);

}  // namespace scene_labeler
