// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "visibility.hpp"

namespace scene_labeler {
namespace {

/// Returns the camera of a projection matrix whose third row has unit length (Hartley and Zisserman 2004,
/// section 6.2.4), without skew.
ViewCamera cameraOfProjection(const Eigen::Matrix<double, 3, 4>& projection, const cv::Mat& image) {
  const Eigen::Vector3d forward = projection.row(2).head<3>();
  ViewCamera camera;
  camera.pinhole.width = image.cols;
  camera.pinhole.height = image.rows;
  camera.R.row(2) = forward;
  camera.t.z() = projection(2, 3);
  const auto decompose = [&](Eigen::Index axis, double& focal, double& centre) {
    const Eigen::Vector3d row = projection.row(axis).head<3>();
    centre = row.dot(forward);
    focal = std::max(1.0, (row - centre * forward).norm());
    camera.R.row(axis) = (row - centre * forward) / focal;
    camera.t[axis] = (projection(axis, 3) - centre * projection(2, 3)) / focal;
  };
  decompose(0, camera.pinhole.fx, camera.pinhole.cx);
  decompose(1, camera.pinhole.fy, camera.pinhole.cy);
  return camera;
}

}  // namespace

void projectScene(const Eigen::Matrix<double, 3, 4>& projection, Scene& scene) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  scene.view.pixels.assign(scene.points.size(), {kNan, kNan});
  scene.view.depths.assign(scene.points.size(), 0.0F);
  const double length = projection.row(2).head<3>().norm();
  const Eigen::Matrix<double, 3, 4> scaled = projection / (length > 0.0 ? length : 1.0);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (!scene.points[i].allFinite()) continue;
    const Eigen::Vector3d uvw = scaled * scene.points[i].cast<double>().homogeneous();
    if (!(uvw.z() > 0.0)) continue;
    scene.view.pixels[i] = (uvw.head<2>() / uvw.z()).cast<float>();
    scene.view.depths[i] = static_cast<float>(uvw.z());
  }
  findVisible(cameraOfProjection(scaled, scene.view.image), scene);
}

bool isUsable(const cv::Mat& image) {
  constexpr int kBlack = 8, kSaturated = 250;  // of 255, brightest channel
  constexpr int kStep = 7;                     // every 49th pixel is sufficient
  std::size_t seen = 0, usable = 0;
  for (int y = 0; y < image.rows; y += kStep)
    for (int x = 0; x < image.cols; x += kStep) {
      const cv::Vec3b& colour = image.at<cv::Vec3b>(y, x);
      const int brightest = std::max({colour[0], colour[1], colour[2]});
      ++seen;
      usable += brightest > kBlack && brightest < kSaturated ? 1U : 0U;
    }
  return seen > 0 && 10 * usable >= seen;
}

}  // namespace scene_labeler
