// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/map_labeler.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/yard.hpp"

namespace scene_labeler {
namespace {

TEST(MapLabeler, LabelsEveryFinitePointByShapeWhereNoImageShowsIt) {
  testing::Yard yard = testing::makeYard(31);
  yard.scene.points[7].x() = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::uint8_t> reflectance(yard.labels.size(), 100);
  MapLabeler labeler(testing::trainOnYards(ClassifierKind::Boosted), 12, 15.0, yard.scene.points, reflectance);
  const std::vector<PointLabel> labels = labeler.finish();
  ASSERT_EQ(labels.size(), yard.labels.size());
  EXPECT_EQ(labels[7].label, SceneClass::None);
  EXPECT_TRUE(labels[7].is_unsure);
  std::size_t right = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) right += labels[i].label == yard.labels[i] ? 1U : 0U;
  EXPECT_GT(right, labels.size() * 9 / 10);
}

TEST(MapLabeler, UsesAnImageForThePointsThatItShows) {
  const testing::Yard yard = testing::makeYard(32);
  const std::vector<std::uint8_t> reflectance(yard.labels.size(), 100);
  MapLabeler labeler(testing::trainOnYards(ClassifierKind::Boosted), 12, 15.0, yard.scene.points, reflectance);
  SideView view;
  view.camera.pinhole = {100.0, 100.0, 50.0, 40.0, 101, 81};
  Eigen::Matrix3d R_world_camera;  // looks along x, at the wall
  R_world_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  view.T_world_camera = urban_nav_core::Pose(Eigen::Quaterniond(R_world_camera), {4.0, 4.0, 1.0});
  EXPECT_EQ(labeler.add(view), 0u) << "no image";
  view.image = cv::Mat(81, 101, CV_8UC3, cv::Scalar(90, 100, 110));
  const std::size_t shown = labeler.add(view);
  EXPECT_GT(shown, 500u);
  EXPECT_LT(shown, yard.labels.size());
  view.T_world_camera = urban_nav_core::Pose(Eigen::Quaterniond(R_world_camera), {4000.0, 4.0, 1.0});
  EXPECT_EQ(labeler.add(view), 0u) << "elsewhere";
}

}  // namespace
}  // namespace scene_labeler
