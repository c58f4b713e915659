// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.hpp"

#include <algorithm>

#include "features/shape_features.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/visibility/depth_map.hpp"

namespace scene_labeler {
namespace {

using urban_nav_registration::ImagePoint;

constexpr double kReturnSpacing = 0.05;   // m, between the returns of a scene
constexpr double kBeamSpacing = 0.01745;  // rad: 1 deg, of the LMS291 (its data sheet)
/// Laser and camera observe a scene from different positions and at different times.
constexpr urban_nav_registration::DepthTolerance kSceneTolerance{0.5F, 0.5F, 0.1F};

bool isInImage(const SceneView& view, std::size_t i) {
  const Eigen::Vector2f& pixel = view.pixels[i];
  return view.depths[i] > 0.0F && pixel.x() >= 0.0F && pixel.y() >= 0.0F &&
         pixel.x() <= static_cast<float>(view.image.cols - 1) && pixel.y() <= static_cast<float>(view.image.rows - 1);
}

}  // namespace

void findVisible(const ViewCamera& camera, Scene& scene) {
  SceneView& view = scene.view;
  view.is_visible.assign(scene.points.size(), 0);
  if (view.image.empty()) return;
  const auto toCamera = [&](std::size_t i) -> Eigen::Vector3d {
    return camera.R * scene.points[i].cast<double>() + camera.t;
  };
  const auto toPlace = [&](std::size_t i, const Eigen::Vector3d& p_cam) {
    return ImagePoint{static_cast<double>(view.pixels[i].x()), static_cast<double>(view.pixels[i].y()), p_cam.norm()};
  };
  const std::vector<Eigen::Vector3f> normals = measureNormals(scene.points);
  urban_nav_registration::DepthMap map(camera.pinhole, kSceneTolerance);
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    if (isInImage(view, i)) {
      const ImagePoint place = toPlace(i, toCamera(i));
      map.add(place, std::max(kReturnSpacing, kBeamSpacing * place.depth));
    }
  urban_nav_core::forEach(scene.points.size(), 2048, [&](std::size_t i) {
    if (!isInImage(view, i)) return;
    const Eigen::Vector3d p_cam = toCamera(i);
    view.is_visible[i] = map.isVisible(toPlace(i, p_cam), {p_cam, camera.R * normals[i].cast<double>()}) ? 1 : 0;
  });
}

}  // namespace scene_labeler
