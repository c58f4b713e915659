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

/// Image of a scene, with the position of each return in it. Each return is projected at its own time, through the
/// lens.
struct SceneView {
  cv::Mat image;                        ///< CV_8UC3, blue, green, red
  std::vector<Eigen::Vector2f> pixels;  ///< one per return, px; NaN if it is not visible in the image
  std::vector<float> depths;            ///< one per return, along the optical axis, m
  /// One per return, 1: visible, that is inside the image, in front of the camera, and not occluded.
  std::vector<std::uint8_t> is_visible;
};

/// Laser returns of one place, with at most one image of them.
struct Scene {
  std::string name;
  std::vector<Eigen::Vector3f> points;  ///< m, z up; points that are not finite are not labelled
  std::vector<float> reflectance;       ///< one per point, in units of its device, NaN for unknown ones; empty if
                                        ///< unavailable
  /// One per point, m: vector to the sensor that measured it. Features then use the reflectance normalised for range
  /// and incidence. Empty: the reflectance is used as it is.
  std::vector<Eigen::Vector3f> to_sensor;
  std::string device;  ///< device of the reflectance: "lms291"; empty: unknown
  SceneView view;      ///< empty image: shape only
  /// One per point, 1: is labelled; 0: only provides context. Empty: all are labelled.
  std::vector<std::uint8_t> is_asked;

  bool isAsked(std::size_t i) const { return is_asked.empty() || is_asked[i] != 0; }
};

/// Projects the points of a scene into its image by a 3x4 matrix M: (u w, v w, w) = M (x, y, z, 1), and determines the
/// visible ones.
void projectScene(const Eigen::Matrix<double, 3, 4>& projection, Scene& scene);

/// Returns whether an image is usable: at least a tenth of its pixels are neither black nor saturated, unlike those of
/// a covered or dazzled camera.
bool isUsable(const cv::Mat& image);

}  // namespace scene_labeler
