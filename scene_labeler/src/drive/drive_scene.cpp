// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/drive/drive_scene.hpp"

#include <limits>

#include "urban_nav_registration/cloud/cell_table.hpp"
#include "visibility.hpp"

namespace scene_labeler {
namespace {

constexpr float kThinningPerM = 20.0F;  // cubes of 5 cm

}  // namespace

void projectView(const SideView& view, const Eigen::Vector3f& origin, Scene& scene) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  scene.view.image = view.image;
  scene.view.pixels.assign(scene.points.size(), {kNan, kNan});
  scene.view.depths.assign(scene.points.size(), 0.0F);
  const urban_nav_core::Pose T_camera_world = view.T_world_camera.inverse();
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3d p_cam = T_camera_world * (scene.points[i] + origin).cast<double>();
    const auto pixel = view.camera.project(p_cam);
    if (!pixel) continue;
    scene.view.pixels[i] = pixel->cast<float>();
    scene.view.depths[i] = static_cast<float>(p_cam.z());
  }
  findVisible({view.camera.pinhole, T_camera_world.R(), T_camera_world * origin.cast<double>()}, scene);
}

DriveScene makeDriveScene(const std::vector<DriveReturn>& returns, const SideView& view) {
  DriveScene drive;
  drive.scene.device = kLms291Device;
  if (returns.empty()) return drive;
  drive.origin = returns.front().point.array().round();
  urban_nav_registration::CellTable table(returns.size() / 2 + 16);
  drive.point_of_return.reserve(returns.size());
  for (std::uint32_t i = 0; i < returns.size(); ++i) {
    const Eigen::Vector3f point = returns[i].point - drive.origin;
    const std::uint32_t cube =
        table.insert(urban_nav_registration::toKey(urban_nav_registration::toCell(point, kThinningPerM)));
    drive.point_of_return.push_back(cube);
    if (cube < drive.scene.points.size()) continue;
    drive.scene.points.push_back(point);
    drive.scene.reflectance.push_back(returns[i].reflectance);
    drive.scene.to_sensor.push_back(returns[i].to_laser);
    drive.first_of_point.push_back(i);
  }
  if (!view.image.empty()) projectView(view, drive.origin, drive.scene);
  return drive;
}

}  // namespace scene_labeler
